// Non-owning views of pictures: the one type that core, drivers and simulator share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace traygauge {

// A rectangle of pixels somewhere else in memory. `stride` counts elements, not bytes.
template <class T>
struct ImageView {
  T* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;

  constexpr ImageView() = default;
  constexpr ImageView(T* data_, int width_, int height_, std::ptrdiff_t stride_)
      : data(data_), width(width_), height(height_), stride(stride_) {}
  constexpr ImageView(T* data_, int width_, int height_) : ImageView(data_, width_, height_, width_) {}

  constexpr operator ImageView<const T>() const requires(!std::is_const_v<T>) {
    return {data, width, height, stride};
  }

  constexpr T* row(int y) const { return data + y * stride; }
  constexpr T& at(int x, int y) const { return row(y)[x]; }
  constexpr bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
  constexpr bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  constexpr ImageView sub(int x, int y, int w, int h) const { return {row(y) + x, w, h, stride}; }
};

enum class PixelFormat : std::uint8_t { gray8, bgr8, rgb8 };

constexpr int bytes_per_pixel(PixelFormat format) {
  return format == PixelFormat::gray8 ? 1 : 3;
}

// One decoded 8-bit picture as a camera delivers it.
struct FrameView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride_bytes = 0;
  PixelFormat format = PixelFormat::bgr8;

  constexpr bool empty() const { return data == nullptr || width <= 0 || height <= 0; }
};

}  // namespace traygauge
