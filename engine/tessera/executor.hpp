// Threads that run the work of frames.
#pragma once

#include <memory>

#include "types.hpp"

namespace tessera {

/// Runs the work of frames on threads of the caller's choice. Without one, renderers use oneTBB.
/// @code
/// struct Threads : Executor {  // new threads for each call; tests/examples/own_threads.cpp keeps a pool
///   int workers() const noexcept override { return 4; }
///   void run(int count, void (*work)(void*, int), void* context) override {
///     std::vector<std::jthread> threads;
///     for (int k = 0; k < count; ++k) threads.emplace_back(work, context, k);
///   }
/// };
/// Renderer on_threads({.executor = std::make_shared<Threads>()});
/// @endcode
class TESSERA_API Executor {
 public:
  virtual ~Executor();

  /// Number of workers that may run at the same time: at least 1, constant. Read when a renderer is created.
  virtual int workers() const noexcept = 0;

  /// Calls work(context, k) once for each k in 0 .. count-1, in any order, concurrently or not, on any
  /// threads; returns after all calls have returned.
  /// - count <= workers(). `work` throws nothing. An exception of run() propagates from finish(), or from
  ///   Frame::draw if the frame has a helper.
  /// - Frames are faster if the same thread runs the same k each time: its data is in that thread's caches.
  /// - One renderer makes one call at a time, and never from inside `work`.
  /// - Several renderers may call it concurrently: from several threads, or from inside `work` if a progress
  ///   callback of one renderer uses another.
  virtual void run(int count, void (*work)(void* context, int worker), void* context) = 0;
};

/// Runs everything on the calling thread.
TESSERA_API std::shared_ptr<Executor> serial_executor();

}  // namespace tessera
