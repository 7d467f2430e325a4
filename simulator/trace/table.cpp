#include "simulator/trace/table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "simulator/trace/error.h"

namespace plumbline {

const Column* Table::find(const std::string& name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Table read_table(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".csv") {
    return read_csv(path);
  }
  if (extension == ".mat") {
    return read_mat(path);
  }
  throw InputError({path, 0, ""}, extension.empty() ? "no file name extension" : "extension " + extension,
                   ".csv or .mat");
}

void require_finite(const Table& table, const std::string& column) {
  const Column* const found = table.find(column);
  if (found == nullptr) {
    std::vector<std::string> names;
    for (const Column& known : table.columns) {
      names.push_back(known.name);
    }
    throw InputError({table.file, 0, column}, "no such column",
                     "a column of the file" + nearest_names(column, names));
  }
  for (Eigen::Index i = 0; i < found->values.size(); ++i) {
    if (!std::isfinite(found->values[i])) {
      throw InputError({table.file, 0, column},
                       (std::isnan(found->values[i]) ? "NaN" : "infinity") + std::string(" in row ") +
                           std::to_string(i + 1),
                       "finite numbers");
    }
  }
}

}  // namespace plumbline
