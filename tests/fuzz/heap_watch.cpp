// Stands in front of glibc's allocator: the linker finds these names first. glibc's own functions
// stay reachable under the names that it documents for this purpose.

#include "tests/fuzz/heap_watch.h"

#include <atomic>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
}

namespace prospect::fuzz {
namespace {

std::atomic<std::size_t> asked{0};

}  // namespace

std::size_t BytesAsked() { return asked; }

}  // namespace prospect::fuzz

extern "C" void* malloc(std::size_t size) noexcept {
  prospect::fuzz::asked += size;
  return __libc_malloc(size);
}

extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
  prospect::fuzz::asked += count * size;
  return __libc_calloc(count, size);
}

extern "C" void* realloc(void* memory, std::size_t size) noexcept {
  prospect::fuzz::asked += size;
  return __libc_realloc(memory, size);
}
