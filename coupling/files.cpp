#include "coupling/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

FileError failure(const std::filesystem::path& file, const char* what) {
  return FileError(fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw FileError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
}

void write_whole(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path beside = file.string() + ".part";
  std::ofstream out(beside, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw failure(beside, "cannot be written");
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error)
    throw FileError(fmt::format("{}: cannot be written: {}", file.string(), error.message()));
}

std::string read_whole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw failure(file, "cannot be read");
  return text.str();
}

LineFile::LineFile(const std::filesystem::path& file, const std::string& first_line)
    : file_(file), descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0644)) {
  if (descriptor_ < 0) throw failure(file, "cannot be written");
  line(first_line);
}

LineFile::~LineFile() { close(descriptor_); }

void LineFile::line(const std::string& text) {
  const std::string whole = text + '\n';
  const off_t end = lseek(descriptor_, 0, SEEK_END);
  if (write(descriptor_, whole.data(), whole.size()) == static_cast<ssize_t>(whole.size())) return;
  const FileError error = failure(file_, "cannot be written");  // a full disk
  if (ftruncate(descriptor_, end) != 0) throw failure(file_, "cannot be cut back to whole lines");
  throw error;
}

}  // namespace bight::coupling
