#pragma once

namespace saker::flight {

/// How often the calling thread allocated so far, by malloc and all that ends in it. The program
/// that is linked with counted_memory.cc has its own malloc, which counts and calls glibc's.
[[nodiscard]] long allocations();

}  // namespace saker::flight
