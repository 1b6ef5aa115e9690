// A fuzz target is a function from bytes to nothing. libFuzzer calls it with bytes of its own making,
// replay.cpp with those of files. tessera::Error is how bad input is refused; whatever else leaves the
// function is a finding, and so is what finding() reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "engine/tessera/tessera.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace tessera::fuzz {

/// Ends the process; the fuzzer keeps the input that led here.
[[noreturn]] inline void finding(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

inline void require(bool condition, const char* what) {
  if (!condition) finding(what);
}

/// The message of the tessera::Error that act() throws. Other exceptions pass.
template <class Act>
std::optional<std::string> error_of(const Act& act) {
  try {
    act();
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace tessera::fuzz
