// A list over memory from the arena: it grows up to its capacity and counts what no longer fits.
#pragma once

#include <cstddef>
#include <span>

namespace traygauge {

template <class T>
class BoundedList {
 public:
  constexpr BoundedList() = default;
  constexpr explicit BoundedList(std::span<T> storage) : storage_(storage) {}

  // False when full; the element is then dropped and counted.
  constexpr bool push_back(const T& value) {
    if (size_ == storage_.size()) {
      ++dropped_;
      return false;
    }
    storage_[size_++] = value;
    return true;
  }
  constexpr void clear() {
    size_ = 0;
    dropped_ = 0;
  }
  // Of these, what does not fit is dropped and counted.
  constexpr void assign(std::span<const T> values) {
    clear();
    for (const T& value : values) push_back(value);
  }
  // Takes in elements that were written behind the end of the list, in its storage.
  constexpr void extend(std::size_t count) {
    size_ = size_ + count < storage_.size() ? size_ + count : storage_.size();
  }
  // Shortens the list; never grows it.
  constexpr void truncate(std::size_t size) { size_ = size < size_ ? size : size_; }

  constexpr std::size_t size() const { return size_; }
  constexpr std::size_t capacity() const { return storage_.size(); }
  constexpr std::size_t dropped() const { return dropped_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr bool full() const { return size_ == storage_.size(); }
  constexpr T& operator[](std::size_t i) { return storage_[i]; }
  constexpr const T& operator[](std::size_t i) const { return storage_[i]; }
  constexpr T* begin() { return storage_.data(); }
  constexpr T* end() { return storage_.data() + size_; }
  constexpr const T* begin() const { return storage_.data(); }
  constexpr const T* end() const { return storage_.data() + size_; }
  constexpr std::span<T> items() { return storage_.first(size_); }
  constexpr std::span<const T> items() const { return storage_.first(size_); }

 private:
  std::span<T> storage_;
  std::size_t size_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace traygauge
