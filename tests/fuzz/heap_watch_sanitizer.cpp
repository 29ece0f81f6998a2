// With a sanitizer, its own allocator tells of each allocation.

#include <atomic>
#include <cstddef>

#include "tests/fuzz/heap_watch.h"

// Of <sanitizer/allocator_interface.h>, which comes with clang and not with GCC; both have the
// function.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace prospect::fuzz {
namespace {

std::atomic<std::size_t> asked{0};

void OnMalloc(const volatile void*, std::size_t size) { asked += size; }
void OnFree(const volatile void*) {}

const int kInstalled = __sanitizer_install_malloc_and_free_hooks(OnMalloc, OnFree);

}  // namespace

std::size_t BytesAsked() { return kInstalled > 0 ? asked.load() : 0; }

}  // namespace prospect::fuzz
