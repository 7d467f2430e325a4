// The page as text: whole, self-contained, and safe against whatever names people use.
#include "validation/report/page.h"

#include <gmock/gmock.h>

#include <regex>

#include "validation/report/repeat_json.h"
#include "validation/report/report.h"

namespace plumbline::validation {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

/// The text between the data's tags.
std::string data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report-data\">";
  const std::size_t from = page.find(open) + open.size();
  return page.substr(from, page.find("</script>", from) - from);
}

const char* const kNasty = "</script><script>alert(1)</script><!-- {{data}} & \"quoted\" \xff";

TEST(Page, IsOneWholeDocument) {
  const std::string page = report_page({{"robot", "A leg"}});
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0U);
  EXPECT_THAT(page, HasSubstr("</html>"));
  EXPECT_THAT(page, HasSubstr("<title>A leg - Plumbline report</title>"));
  EXPECT_EQ(page.find("{{"), std::string::npos) << page.substr(page.find("{{"), 40);
  for (const char* tag : {"html", "head", "body", "main", "header", "nav", "style", "title"}) {
    EXPECT_EQ(count_of(page, std::string("</") + tag + ">"), 1U) << tag;
  }
  EXPECT_EQ(count_of(page, "<script"), count_of(page, "</script>"));
  EXPECT_EQ(count_of(page, "<section"), count_of(page, "</section>"));
}

TEST(Page, NeedsNoNetwork) {
  const std::string page = report_page({{"robot", "A leg"}});
  for (const char* loads : {" src=", "<link", "@import", "url(", "fetch(", "XMLHttpRequest", "import("}) {
    EXPECT_THAT(page, Not(HasSubstr(loads)));
  }
}

TEST(Page, CarriesTheLicenceOfItsDrawingLibrary) {
  EXPECT_THAT(report_page({{"robot", ""}}), HasSubstr("Permission is hereby granted, free of charge"));
}

TEST(Page, LinksWithinItselfLeadSomewhere) {
  const std::string page = page_files().html;
  const std::regex link("href=\"#([a-z-]+)\"");
  for (std::sregex_iterator it(page.begin(), page.end(), link), end; it != end; ++it) {
    EXPECT_THAT(page, HasSubstr("id=\"" + (*it)[1].str() + "\""));
  }
}

TEST(Page, NoNameCanBreakOutOfTheData) {
  const json report{{"robot", "{{style}}"}, {"trial", kNasty}};
  const std::string page = report_page(report);
  EXPECT_EQ(count_of(page, "<script"), 3U);
  const json back = json::parse(data_of(page));
  EXPECT_EQ(back["robot"], "{{style}}");
  EXPECT_THAT(back["trial"].get<std::string>(), HasSubstr("</script><script>alert(1)</script>"));
  EXPECT_THAT(data_of(page), Not(HasSubstr("<")));
}

TEST(Page, NoNameCanBreakOutOfTheTitle) {
  EXPECT_EQ(html_text("<b>&\"</b>"), "&lt;b&gt;&amp;&quot;&lt;/b&gt;");
  EXPECT_EQ(count_of(report_page({{"robot", "<script>"}}), "<script"), 3U);
}

TEST(ShellLine, QuotesWhatAShellWouldTouch) {
  EXPECT_EQ(shell_line({"plumbline", "report", "a b", "it's", "", "--x=1.5", "viscous@*"}),
            "plumbline report 'a b' 'it'\\''s' '' --x=1.5 'viscous@*'");
}

}  // namespace
}  // namespace plumbline::validation
