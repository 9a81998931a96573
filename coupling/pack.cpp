#include "coupling/pack.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace bight::coupling {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T>
std::string base64_of(const std::vector<T>& words) {
  return base64({reinterpret_cast<const std::uint8_t*>(words.data()), words.size() * sizeof(T)});
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t here = std::min<size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (size_t k = 0; k < 3; ++k) three = three << 8 | (k < here ? bytes[i + k] : 0);
    for (size_t k = 0; k < 4; ++k) text += k <= here ? letters[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

nlohmann::ordered_json pack(std::span<const double> values) {
  if (values.empty()) return {{"from", 0.0}, {"step", 0.0}, {"words", ""}};
  const auto [from, to] = std::ranges::minmax(values);
  const double step = (to - from) / 65535;
  std::vector<std::uint16_t> words;
  words.reserve(values.size());
  for (const double value : values)
    words.push_back(step > 0 ? static_cast<std::uint16_t>(std::lround((value - from) / step))
                             : std::uint16_t{0});
  return {{"from", from}, {"step", step}, {"words", base64_of(words)}};
}

nlohmann::ordered_json pack(std::span<const std::uint32_t> indices) {
  return {{"words", base64_of(std::vector<std::uint32_t>(indices.begin(), indices.end()))}};
}

}  // namespace bight::coupling
