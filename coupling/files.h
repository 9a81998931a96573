#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace bight::coupling {

void make_folder(const std::filesystem::path& folder);

/// Writes a file beside and renames it: at every instant the old or the new one is there, whole.
void write_whole(const std::filesystem::path& file, std::string_view text);

std::string read_whole(const std::filesystem::path& file);

/// A file that grows by whole lines: each is handed to the system in one piece.
class LineFile {
 public:
  LineFile(const std::filesystem::path& file, const std::string& first_line);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  void line(const std::string& text);

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace bight::coupling
