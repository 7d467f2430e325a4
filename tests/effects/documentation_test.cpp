// The table for readers: one whole row for each law.
#include "simulator/effects/documentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace plumbline::effects {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Bars that separate cells, that is those without a backslash before them.
int separators(const std::string& line) {
  int count = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '|' && (i == 0 || line[i - 1] != '\\')) ++count;
  }
  return count;
}

TEST(DocumentationTable, HasOneRowForEachLawAndEqualCells) {
  const Catalogue catalogue = Catalogue::all();
  const auto lines = lines_of(documentation_table(catalogue));
  ASSERT_EQ(lines.size(), catalogue.laws().size() + 2);
  for (const auto& line : lines) EXPECT_EQ(separators(line), 8) << line;
  for (std::size_t i = 0; i < catalogue.laws().size(); ++i) {
    EXPECT_THAT(lines[i + 2], testing::HasSubstr("**" + catalogue.laws()[i]->declaration().name + "**"));
  }
}

TEST(DocumentationTable, ShowsUnitsBoundsAndEquation) {
  const std::string table = documentation_table(Catalogue::all());
  EXPECT_THAT(table, testing::HasSubstr("`f = -damping*v`"));
  EXPECT_THAT(table,
              testing::HasSubstr("`damping` [N m s/rad or N s/m] damping coefficient; null 0, 0 to inf"));
  EXPECT_THAT(table, testing::HasSubstr("f = -difference*\\|v\\|"));
}

TEST(UnitInWords, NamesBothPlacesOnlyWhereTheyDiffer) {
  EXPECT_EQ(unit_in_words("{force}"), "N m or N");
  EXPECT_EQ(unit_in_words("kg"), "kg");
}

}  // namespace
}  // namespace plumbline::effects
