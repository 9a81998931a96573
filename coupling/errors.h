#pragma once

#include <stdexcept>

namespace bight::coupling {

/// Something the user wrote cannot be used. One line per problem. Exit status 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written. Exit status 3.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bight::coupling
