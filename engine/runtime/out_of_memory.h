// Translation of std::bad_alloc into Error.
#pragma once

#include <new>
#include <string>

#include "engine/tessera/tessera.hpp"

namespace tessera::detail {

/// Calls run(). std::bad_alloc becomes an Error with out_of_memory that names the function.
template <class Run>
decltype(auto) translate_bad_alloc(const char* function, const Run& run) {
  try {
    return run();
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, std::string(function) + ": not enough memory");
  }
}

}  // namespace tessera::detail
