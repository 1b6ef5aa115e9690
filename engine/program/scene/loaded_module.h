// Loads modules: shared libraries that hide a heavy dependency behind C functions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

/// Returns the handle of a module, which stays loaded. Searches the folder of the running program, ../lib
/// from there, and the system's library path.
/// @throws Error "<wanted_for> needs the module <file_name>, ...; <otherwise>" if it is missing
void* load_module(const char* file_name, const std::string& wanted_for, const char* otherwise);

/// @throws Error for a module of another version
void* function_of(void* module, const char* file_name, const char* name);

/// Runs call(take, user, message, message_size) and returns the bytes that it passed to take(user, bytes,
/// count). call() is a function of a module; it returns 0, 1 with a message, or 2 if it runs out of memory.
/// @throws Error with the message, in one line
/// @throws std::bad_alloc
template <class Call>
std::string collect_bytes(const Call& call) {
  struct Taken {
    std::string bytes;
    bool fits = true;
  } taken;
  // No exception may cross the C interface.
  const auto take = [](void* user, const unsigned char* from, std::size_t count) noexcept {
    auto& to = *static_cast<Taken*>(user);
    try {
      to.bytes.append(reinterpret_cast<const char*>(from), count);
    } catch (const std::exception&) {
      to.fits = false;
    }
  };
  char message[1024] = "";
  const int result = call(+take, static_cast<void*>(&taken), message, sizeof message);
  if (result == 2 || !taken.fits) throw std::bad_alloc();
  if (result == 0) return std::move(taken.bytes);
  std::string reason = message;
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw Error(reason);
}

}  // namespace tessera::program
