// The storage of a frame buffer: a stack of bitplanes, one bit per pixel and plane.
//
// A pixel is a value of up to 32 bits; plane k holds bit k of every pixel. Each plane is a separate image:
// top row first, bit 7 of a byte is the leftmost pixel. Rows are padded to whole cache lines (512 pixels). A
// plane takes an odd number of lines, so that a pixel's bits in neighbouring planes do not compete for one
// cache set. Pad bits are always 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include "framebuffer/check.h"

namespace tessera::detail {

inline constexpr int kMaxPlanes = 32;
inline constexpr int kPlaneAlignment = 64;               ///< bytes; rows of a plane are padded to it
inline constexpr int kLinePixels = kPlaneAlignment * 8;  ///< pixels of a plane in one cache line

/// A stack of planes of one size. allocate() takes the memory, the constructor does not. Move-only; a
/// moved-from stack has no memory.
class BitplaneStack {
 public:
  BitplaneStack() = default;
  ~BitplaneStack() { release(); }
  BitplaneStack(BitplaneStack&&) noexcept = default;
  BitplaneStack& operator=(BitplaneStack&& other) noexcept {
    release();
    width_px_ = other.width_px_;
    height_px_ = other.height_px_;
    plane_count_ = other.plane_count_;
    stride_bytes_ = other.stride_bytes_;
    plane_stride_bytes_ = other.plane_stride_bytes_;
    memory_ = std::move(other.memory_);
    external_memory_ = other.external_memory_;
    return *this;
  }
  /// @param width_px, height_px  at least 1;  @param plane_count  0 .. kMaxPlanes
  BitplaneStack(int width_px, int height_px, int plane_count) noexcept;

  int width_px() const noexcept { return width_px_; }
  int height_px() const noexcept { return height_px_; }
  int plane_count() const noexcept { return plane_count_; }
  /// Mask of the bits that a pixel of this stack has.
  std::uint32_t value_mask() const noexcept {
    return plane_count_ == 0 ? 0 : ~std::uint32_t{0} >> (kMaxPlanes - plane_count_);
  }

  /// Size of the planes in bytes, allocated or not.
  std::size_t needed_bytes() const noexcept {
    return plane_stride_bytes_ * static_cast<std::size_t>(plane_count_);
  }
  /// Places the planes in the caller's memory: needed_bytes() bytes, kPlaneAlignment aligned, which outlive
  /// the stack. allocate() and release() then neither allocate nor free. @pre not allocated
  void use_external_memory(std::uint8_t* memory) noexcept {
    TESSERA_ASSERT(!allocated() && reinterpret_cast<std::uintptr_t>(memory) % kPlaneAlignment == 0);
    external_memory_ = memory;
  }
  bool uses_external_memory() const noexcept { return external_memory_ != nullptr; }

  bool allocated() const noexcept { return memory_ != nullptr; }
  /// Takes the memory and fills every pixel with `value`. Does nothing if allocated already. Throws
  /// std::bad_alloc, with the strong guarantee.
  void allocate(std::uint32_t value);
  void release() noexcept {
    if (external_memory_ != nullptr) static_cast<void>(memory_.release());
    memory_.reset();
  }

  /// Sets every pixel to `value`; bits beyond the planes are ignored. @pre allocated, here and below
  void fill(std::uint32_t value) noexcept { fill_rows(0, height_px_, value); }
  /// Sets the rows y0 <= y < y1. Distinct rows may be filled concurrently.
  void fill_rows(int y0, int y1, std::uint32_t value) noexcept;

  /// One pixel, y from the top. Slow: for tests and single pixels.
  std::uint32_t pixel(int x, int y) const noexcept;
  void set_pixel(int x, int y, std::uint32_t value) noexcept;

  /// Top row of plane k, kPlaneAlignment aligned.
  std::uint8_t* plane(int k) noexcept {
    TESSERA_ASSERT(allocated() && k >= 0 && k < plane_count_);
    return memory_.get() + static_cast<std::size_t>(k) * plane_stride_bytes();
  }
  const std::uint8_t* plane(int k) const noexcept {
    TESSERA_ASSERT(allocated() && k >= 0 && k < plane_count_);
    return memory_.get() + static_cast<std::size_t>(k) * plane_stride_bytes();
  }
  /// Distance from a row of a plane to the row below it.
  std::ptrdiff_t stride_bytes() const noexcept { return stride_bytes_; }
  /// Distance from a plane to the next one.
  std::size_t plane_stride_bytes() const noexcept { return plane_stride_bytes_; }
  /// Memory in use; 0 while not allocated.
  std::size_t bytes() const noexcept { return allocated() ? needed_bytes() : 0; }

 private:
  struct AlignedDelete {
    void operator()(std::uint8_t* memory) const noexcept {
      ::operator delete (memory, std::align_val_t{kPlaneAlignment});
    }
  };
  int width_px_ = 0, height_px_ = 0;
  int plane_count_ = 0;
  std::ptrdiff_t stride_bytes_ = 0;
  std::size_t plane_stride_bytes_ = 0;
  std::unique_ptr<std::uint8_t[], AlignedDelete> memory_;
  std::uint8_t* external_memory_ = nullptr;  // memory of the caller; null: the stack allocates
};

}  // namespace tessera::detail
