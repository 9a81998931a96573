#include "coupling/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "coupling/errors.h"
#include "coupling/files.h"
#include "coupling/report_data.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string replaced(std::string text, char what, std::string_view with) {
  for (size_t at = 0; (at = text.find(what, at)) != text.npos; at += with.size())
    text.replace(at, 1, with);
  return text;
}

std::string escaped(const std::string& text) {
  return replaced(replaced(text, '&', "&amp;"), '<', "&lt;");
}

std::string title_of(const Json& data) {
  const std::string title = data["scene"].value("title", "");
  return title.empty() ? data["folder"].get<std::string>() : title;
}

// The policy keeps the page from loading anything, even by mistake.
std::string page(const Json& data, const std::string& script) {
  std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
         "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>" +
         escaped(title_of(data)) +
         "</title>\n</head>\n<body>\n"
         "<noscript>This page draws itself: it needs JavaScript.</noscript>\n"
         "<script type=\"application/json\" id=\"data\">" +
         replaced(std::move(json), '<', "\\u003c") + "</script>\n<script>" + script +
         "</script>\n</body>\n</html>\n";
}

}  // namespace

void report(const fs::path& folder, const ReportOptions& options) {
  const fs::path script_file =
      options.script.empty() ? fs::path(BIGHT_REPORT_SCRIPT) : options.script;
  const bool built = fs::is_regular_file(script_file);
  const std::string script = built ? read_whole(script_file) : "";
  constexpr size_t frame = 10'000;  // the page around data and script
  const Json data = report_data(folder, options.measured,
                                largest_report - std::min(largest_report, script.size() + frame));
  if (!built)
    throw FileError(
        fmt::format("{}: there is no such file; ./bight report builds it", script_file.string()));
  const fs::path out = options.out.empty() ? folder / "report.html" : options.out;
  const std::string html = page(data, script);
  if (html.size() > largest_report)
    throw FileError(fmt::format("{}: not written: {:.1f} MB, and {:.0f} MB is the limit",
                                out.string(), 1e-6 * html.size(), 1e-6 * largest_report));
  write_whole(out, html);
  fmt::print("{}: {:.1f} MB, open it in a browser\n", out.string(), 1e-6 * html.size());
}

}  // namespace bight::coupling
