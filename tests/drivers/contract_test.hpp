// A contract test opens its rig, or is skipped where there is none.
#pragma once

#include <gtest/gtest.h>

#include "tests/drivers/device_rigs.hpp"

namespace traygauge {

template <class RigType>
class ContractTest : public testing::TestWithParam<RigMaker<RigType>> {
 protected:
  void SetUp() override {
    rig_ = this->GetParam().make();
    if (rig_ == nullptr) GTEST_SKIP() << this->GetParam().name << " is not connected";
  }
  void TearDown() override {
    if (rig_ != nullptr) rig_->device().stop();
  }
  auto& device() { return rig_->device(); }
  Clock& clock() { return rig_->clock(); }
  RigType& rig() { return *rig_; }

 private:
  std::unique_ptr<RigType> rig_;
};

inline constexpr auto kRigName = [](const auto& info) { return info.param.name; };

}  // namespace traygauge
