// A value, or the sentence that says why there is none.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace traygauge {

// Why something did not work, for people: file or device, expected, found, what to do.
struct Failure {
  std::string text;
};

// What firmware's functions return that meet failures in daily use: a full disk, an absent hub. Inputs that
// somebody has to mend before the program can start throw InputError instead.
template <class T>
class [[nodiscard]] Expected {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a function returns its failure or its value as they are
  Expected(T value) : content_(std::move(value)) {}
  Expected(Failure failure) : content_(std::move(failure)) {}
  // NOLINTEND(google-explicit-constructor)

  bool ok() const { return std::holds_alternative<T>(content_); }
  const std::string& failure() const {
    assert(!ok());
    return std::get<Failure>(content_).text;
  }

  T& value() {
    assert(ok());
    return std::get<T>(content_);
  }
  const T& value() const {
    assert(ok());
    return std::get<T>(content_);
  }
  T& operator*() { return value(); }
  const T& operator*() const { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

 private:
  std::variant<T, Failure> content_;
};

// Of a function that gives nothing but may fail: `return {}` says that it worked.
template <>
class [[nodiscard]] Expected<void> {
 public:
  Expected() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  Expected(Failure failure) : failure_(std::move(failure.text)), ok_(false) {}

  bool ok() const { return ok_; }
  const std::string& failure() const {
    assert(!ok());
    return failure_;
  }

 private:
  std::string failure_;
  bool ok_ = true;
};

}  // namespace traygauge
