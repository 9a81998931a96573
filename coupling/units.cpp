#include "coupling/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

Unit parse_unit(const std::string& text) {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  if (!system) throw FileError("the unit database of udunits2 cannot be read");
  return {ut_parse(system, text.c_str(), UT_UTF8), &ut_free};
}

// udunits takes "mm 5" for 5 mm; a second number in a quantity is a slip. "1/s" is not.
bool has_second_number(std::string_view unit) {
  bool token_begins = true;
  for (size_t i = 0; i < unit.size(); ++i) {
    const char c = unit[i];
    if (token_begins && c >= '0' && c <= '9' && unit.substr(i, 2) != "1/") return true;
    token_begins = c == ' ' || c == '*' || c == '/' || c == '.' || c == ',' || c == '(';
  }
  return false;
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

double parse_quantity(std::string_view text, const std::string& unit) {
  const auto refuse = [&](const std::string& why) {
    return InputError(fmt::format("\"{}\" {}; write a number and a unit of {}", text, why, unit));
  };
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc{}) throw refuse("does not begin with a number");
  if (!std::isfinite(value)) throw refuse("is not a finite number");
  const std::string given(trim(rest.substr(end - rest.data())));
  if (given.empty()) throw refuse("has no unit");
  if (given == unit) return value;  // a conversion m -> m may lose the last digit

  const Unit from = parse_unit(given), to = parse_unit(unit);
  if (!from || has_second_number(given)) throw refuse(fmt::format("has no unit known ({})", given));
  if (!ut_are_convertible(from.get(), to.get())) throw refuse("is of another kind");
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(
      ut_get_converter(from.get(), to.get()), &cv_free);
  // mm -> m divides by 1000 rather than multiply by 0.001: "350 mm" is the same double as 0.35.
  const double factor = cv_convert_double(converter.get(), 1), inverse = std::round(1 / factor);
  const bool proportional = cv_convert_double(converter.get(), 0) == 0;
  if (proportional && factor < 1 && std::abs(inverse * factor - 1) < 1e-12) return value / inverse;
  return factor == 1 && proportional ? value : cv_convert_double(converter.get(), value);
}

}  // namespace bight::coupling
