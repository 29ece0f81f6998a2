#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace prospect::model::inference {

/// Memory for one computation: taken piece by piece, given back all at once where a Scope ends, in
/// the reverse order of beginning. Grows until it has seen the largest computation; from then on
/// nothing is allocated. One thread at a time.
class Arena {
 public:
  /// What is taken while one lives is free again when it ends.
  class Scope {
   public:
    explicit Scope(Arena& arena) : arena_(arena), block_(arena.block_), used_(arena.used_) {}
    ~Scope() { arena_.Return(block_, used_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Arena& arena_;
    std::size_t block_, used_;
  };

  /// `count` uninitialised numbers or pointers, on a boundary of 64 bytes.
  template <typename T = float>
  T* Take(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    return static_cast<T*>(TakeBytes(count * sizeof(T)));
  }

  /// Bytes that it holds.
  std::size_t capacity() const {
    std::size_t bytes = 0;
    for (const Block& block : blocks_) bytes += block.size;
    return bytes;
  }

 private:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kSmallest = std::size_t{1} << 16;

  struct Free {
    void operator()(std::byte* bytes) const {
      ::operator delete (bytes, std::align_val_t{kAlignment});
    }
  };
  struct Block {
    std::unique_ptr<std::byte, Free> bytes;
    std::size_t size = 0;
  };

  void* TakeBytes(std::size_t bytes) {
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    while (block_ < blocks_.size() && used_ + bytes > blocks_[block_].size) ++block_, used_ = 0;
    if (block_ == blocks_.size()) Grow(bytes);
    std::byte* const at = blocks_[block_].bytes.get() + used_;
    used_ += bytes;
    return at;
  }

  void Grow(std::size_t bytes) {
    const std::size_t size = std::max({bytes, kSmallest, capacity()});
    auto* memory = static_cast<std::byte*>(::operator new (size, std::align_val_t{kAlignment}));
    blocks_.push_back({std::unique_ptr<std::byte, Free>(memory), size});
    block_ = blocks_.size() - 1;
    used_ = 0;
  }

  void Return(std::size_t block, std::size_t used) {
    block_ = block;
    used_ = used;
  }

  std::vector<Block> blocks_;
  std::size_t block_ = 0, used_ = 0;  // where the next piece may begin
};

}  // namespace prospect::model::inference
