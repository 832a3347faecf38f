#include "firmware/journal/io_failure.hpp"

namespace traygauge {

std::string_view io_advice(std::error_code error) {
  if (error == std::errc::no_space_on_device) return "Free space on this disk.";
  if (error == std::errc::read_only_file_system) {
    return "The disk is mounted read-only, often after an error: check it and mount it for writing.";
  }
  if (error == std::errc::permission_denied || error == std::errc::operation_not_permitted) {
    return "Give the program's user the right to write there.";
  }
  if (error == std::errc::io_error) return "Check the disk or card and replace it.";
  if (error == std::errc::no_such_file_or_directory) return "Make the folder, or correct the path.";
  if (error == std::errc::is_a_directory) return "Name a file, not a folder.";
  return {};
}

Failure io_failure(std::string_view path, std::string_view what, std::error_code error) {
  std::string text(path);
  text.append(": ").append(what).append(": ").append(error.message()).append(".");
  if (const std::string_view advice = io_advice(error); !advice.empty()) text.append(" ").append(advice);
  return {text};
}

}  // namespace traygauge
