// The page of `verify --report`: no text of a scene escapes from the page's JSON.
#include "host/verify/page.hpp"

#include <nlohmann/json.hpp>

#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

struct Parts {
  std::string before, data, after;  // parts of the page; `data` is the JSON that its script reads
};

Parts page_with(const std::string& text) {
  compare::Report report;
  report.scene = report.not_verified = text;
  verify::Page page;
  page.add(report);
  const std::string html = page.html(text), begin = "<script type=\"application/json\" id=\"data\">";
  const size_t from = html.find(begin) + begin.size(), to = html.find("</script>", from);
  return {html.substr(0, from), html.substr(from, to - from), html.substr(to)};
}

}  // namespace

TEST_CASE("nasty text stays in the page's JSON, and is unchanged") {
  const Parts plain = page_with("plain");
  for (const std::string& text : test::nasty_strings) {
    CAPTURE(text);
    const Parts parts = page_with(text);
    CHECK(parts.before == plain.before);
    CHECK(parts.after == plain.after);
    CHECK(parts.data.find('<') == std::string::npos);
    const auto data = nlohmann::json::parse(parts.data);
    if (text.find('\xff') != std::string::npos) continue;  // JSON holds UTF-8 only
    CHECK(data.at("summary") == text);
    CHECK(data.at("scenes").at(0).at("scene") == text);
    CHECK(data.at("scenes").at(0).at("not_verified") == text);
  }
}
