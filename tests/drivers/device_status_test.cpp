#include "drivers/device_status.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <set>
#include <string>

namespace traygauge {
namespace {

TEST(DeviceStatus, EveryCodeHasANameAndASentenceOfItsOwn) {
  std::set<std::string> names;
  std::set<std::string> sentences;
  for (int i = 0; i < kDeviceCodeCount; ++i) {
    const auto code = static_cast<DeviceCode>(i);
    names.insert(name(code));
    sentences.insert(sentence(code));
    EXPECT_EQ(std::string(sentence(code)).back(), '.') << name(code);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kDeviceCodeCount));
  EXPECT_EQ(sentences.size(), static_cast<std::size_t>(kDeviceCodeCount));
  EXPECT_STREQ(name(DeviceCode::io_error), "io_error");
}

TEST(DeviceStatus, KeepsTheSystemsError) {
  const DeviceStatus status(DeviceCode::device_gone, ENODEV);
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(status.error_number(), ENODEV);
}

TEST(DeviceStatus, SaysWhatAnErrnoMeans) {
  EXPECT_TRUE(status_of_errno(0).ok());
  EXPECT_EQ(status_of_errno(ENODEV).code(), DeviceCode::device_gone);
  EXPECT_EQ(status_of_errno(EACCES).code(), DeviceCode::no_permission);
  EXPECT_EQ(status_of_errno(EBUSY).code(), DeviceCode::in_use);
  EXPECT_EQ(status_of_errno(EIO).code(), DeviceCode::io_error);
  EXPECT_EQ(status_of_errno(EIO).error_number(), EIO);
}

}  // namespace
}  // namespace traygauge
