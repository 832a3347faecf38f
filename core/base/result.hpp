// A value, or the status that says why there is none.
#pragma once

#include <cassert>
#include <utility>

#include "core/base/status.hpp"

namespace traygauge {

// What a function returns that can fail and gives one small value. The value exists only where ok(), so that
// nobody reads what a refusal has left half done; to ask for it elsewhere is a mistake of the program.
template <class T>
class [[nodiscard]] Result {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a function returns its refusal or its value as they are
  constexpr Result(T value) : value_(std::move(value)) {}
  constexpr Result(Status refusal) : status_(refusal) { assert(!refusal.ok()); }
  constexpr Result(StatusCode refusal) : Result(Status(refusal)) {}
  // NOLINTEND(google-explicit-constructor)

  constexpr bool ok() const { return status_.ok(); }
  constexpr Status status() const { return status_; }
  constexpr StatusCode code() const { return status_.code(); }

  constexpr const T& value() const {
    assert(ok());
    return value_;
  }
  constexpr const T& operator*() const { return value(); }
  constexpr const T* operator->() const { return &value(); }

 private:
  Status status_;
  T value_{};
};

}  // namespace traygauge
