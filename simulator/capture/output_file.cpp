#include "simulator/capture/output_file.hpp"

#include <cerrno>
#include <system_error>

#include "simulator/capture/input_error.hpp"

namespace traygauge {

OutputError::OutputError(const std::filesystem::path& file, const std::string& reason)
    : std::runtime_error(printable(file.string() + ": cannot be written: " + reason +
                                   "; name a file in an existing, writable folder")) {}

void write_stream(const std::filesystem::path& file, const std::function<bool(std::FILE*)>& encode) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (stream == nullptr) throw OutputError(file, std::generic_category().message(errno));
  const bool encoded = encode(stream);
  const int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (encoded && closed) return;
  const int failure = encoded ? errno : reason;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  throw OutputError(file, std::generic_category().message(failure));
}

}  // namespace traygauge
