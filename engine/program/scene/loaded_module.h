// Modules: shared libraries that hide a heavy dependency behind C functions, loaded on first need.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "engine/tessera/tessera.hpp"

namespace tessera::program {

/// A module's handle: looked for beside the running program, in ../lib from there, and where the system looks
/// for libraries. It stays loaded. @throws Error "<wanted_for> needs the module <file_name>, ...;
/// <otherwise>" where it is missing.
void* load_module(const char* file_name, const std::string& wanted_for, const char* otherwise);

/// @throws Error for a module of another version.
void* function_of(void* module, const char* file_name, const char* name);

/// Functions of modules hand out bytes by take(user, bytes, count), and return 0, or 1 and a reason, or 2:
/// not enough memory. Runs call(take, user, message, message size) and returns what it took. @throws Error
/// with the reason, in one line; std::bad_alloc.
template <class Call>
std::string collect_bytes(const Call& call) {
  struct Taken {
    std::string bytes;
    bool fits = true;
  } taken;
  // No exception crosses the C border.
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
