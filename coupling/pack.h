#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace bight::coupling {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// Numbers on 65,536 equal steps between their smallest and largest, so each is off by at most half
/// a step: {"from", "step", "words"}; value = from + step * word, words little-endian in base64.
nlohmann::ordered_json pack(std::span<const double> values);

/// Numbers of points, as they are: {"words"}, of 4 bytes each.
nlohmann::ordered_json pack(std::span<const std::uint32_t> indices);

}  // namespace bight::coupling
