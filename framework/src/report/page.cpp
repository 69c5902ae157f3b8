// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.hpp"

#include "report/page_parts.hpp"

namespace cambium {
namespace {

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// Text of a script element: a name that holds "</script>" must not end it.
std::string embedded(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  replace_all(text, "<", "\\u003c");
  return text;
}

std::string scripts() {
  std::string out;
  for (const auto& [name, text] : page_parts())
    if (name.ends_with(".js")) out += text;  // by name: 1_data.js, 2_...
  return out;
}

}  // namespace

std::string report_page(const Atlas& atlas, const Json& report, const std::string& resolved) {
  const Json map{{"missions", page_missions(atlas)},
                 {"ledger", page_ledger(atlas)},
                 {"islands", report.at("islands")},
                 {"resolved", resolved}};
  Json run = report;
  for (Json& step : run.at("steps")) step.erase("key");  // thousands of digits that nobody reads
  std::string page = page_parts().at("page.html");
  // The data come last: what they hold is not searched for these words.
  replace_all(page, "/*STYLE*/", page_parts().at("page.css"));
  replace_all(page, "/*SCRIPTS*/", scripts());
  page.replace(page.find("/*MAP*/"), 7, embedded(map));
  page.replace(page.rfind("/*RUN*/"), 7, embedded(run));
  return page;
}

}  // namespace cambium
