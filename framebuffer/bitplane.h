// The frame buffer's storage: a stack of bitplanes, literally one bit for each pixel in each plane.
//
// A pixel's word is up to 32 bits; plane k holds bit k of every pixel. Planes are separate images: the top
// row first, bit 7 of a byte the leftmost pixel. Rows are padded to whole cache lines (512 pixels), and a
// plane takes an odd number of them, so that the same pixel of neighbouring planes never competes for one set
// of a cache. Pad bits are always 0.
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
inline constexpr int kLinePixels = kPlaneAlignment * 8;  ///< of a plane in a cache line

/// A stack of planes of one size. Memory is taken at allocate(), not before. Copying is not offered; moving
/// leaves a stack without memory behind.
class BitplaneStack {
 public:
  BitplaneStack() = default;
  ~BitplaneStack() { release(); }
  BitplaneStack(BitplaneStack&&) noexcept = default;
  BitplaneStack& operator=(BitplaneStack&& other) noexcept {
    release();
    width_px_ = other.width_px_, height_px_ = other.height_px_, plane_count_ = other.plane_count_;
    stride_bytes_ = other.stride_bytes_, plane_stride_bytes_ = other.plane_stride_bytes_;
    memory_ = std::move(other.memory_);
    external_memory_ = other.external_memory_;
    return *this;
  }
  /// @param width_px, height_px  at least 1;  @param plane_count  0 .. kMaxPlanes
  BitplaneStack(int width_px, int height_px, int plane_count) noexcept;

  int width_px() const noexcept { return width_px_; }
  int height_px() const noexcept { return height_px_; }
  int plane_count() const noexcept { return plane_count_; }
  /// Bits that a word of this stack may have.
  std::uint32_t value_mask() const noexcept {
    return plane_count_ == 0 ? 0 : ~std::uint32_t{0} >> (kMaxPlanes - plane_count_);
  }

  /// Bytes that the planes take, allocated or not.
  std::size_t needed_bytes() const noexcept {
    return plane_stride_bytes_ * static_cast<std::size_t>(plane_count_);
  }
  /// From now on the planes stand in this memory, needed_bytes() at a multiple of kPlaneAlignment, which
  /// outlives the stack; taking and giving back allocates nothing. @pre not allocated
  void use_external_memory(std::uint8_t* memory) noexcept {
    TESSERA_ASSERT(!allocated() && reinterpret_cast<std::uintptr_t>(memory) % kPlaneAlignment == 0);
    external_memory_ = memory;
  }
  bool uses_external_memory() const noexcept { return external_memory_ != nullptr; }

  bool allocated() const noexcept { return memory_ != nullptr; }
  /// Takes the memory, if it is not there yet, and fills every pixel with `word`. Throws std::bad_alloc; then
  /// nothing changed.
  void allocate(std::uint32_t word);
  void release() noexcept {
    if (external_memory_ != nullptr) static_cast<void>(memory_.release());
    memory_.reset();
  }

  /// Every pixel becomes `word` (bits beyond the planes are ignored). Allocated stacks only, as for all that
  /// follows.
  void fill(std::uint32_t word) noexcept { fill_rows(0, height_px_, word); }
  /// The same for the rows y0 <= y < y1; distinct rows may be filled by distinct threads.
  void fill_rows(int y0, int y1, std::uint32_t word) noexcept;

  /// The word of one pixel, y from the top: the slow path, for tests and single pixels.
  std::uint32_t pixel(int x, int y) const noexcept;
  void set_pixel(int x, int y, std::uint32_t word) noexcept;

  /// Plane k: its top row, kPlaneAlignment aligned.
  std::uint8_t* plane(int k) noexcept {
    TESSERA_ASSERT(allocated() && k >= 0 && k < plane_count_);
    return memory_.get() + static_cast<std::size_t>(k) * plane_stride_bytes();
  }
  const std::uint8_t* plane(int k) const noexcept {
    TESSERA_ASSERT(allocated() && k >= 0 && k < plane_count_);
    return memory_.get() + static_cast<std::size_t>(k) * plane_stride_bytes();
  }
  /// From a row of a plane to the row below it.
  std::ptrdiff_t stride_bytes() const noexcept { return stride_bytes_; }
  /// From a plane to the next.
  std::size_t plane_stride_bytes() const noexcept { return plane_stride_bytes_; }
  /// Memory taken now; 0 while not allocated.
  std::size_t bytes() const noexcept { return allocated() ? needed_bytes() : 0; }

 private:
  struct AlignedDelete {
    void operator()(std::uint8_t* memory) const noexcept {
      ::operator delete (memory, std::align_val_t{kPlaneAlignment});
    }
  };
  int width_px_ = 0, height_px_ = 0, plane_count_ = 0;
  std::ptrdiff_t stride_bytes_ = 0;
  std::size_t plane_stride_bytes_ = 0;
  std::unique_ptr<std::uint8_t[], AlignedDelete> memory_;
  std::uint8_t* external_memory_ = nullptr;  // the caller's memory; else the stack takes its own
};

}  // namespace tessera::detail
