#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace prospect::model {

/// Threads that stay, for work that comes in rows: each row is computed whole by one thread, so its
/// result does not depend on how many threads or other rows there are. Run may be called by one
/// thread at a time.
class RowPool {
 public:
  /// `threads` in all, the caller's own included; `start` is called once in each of the others.
  RowPool(int threads, std::function<void()> start);
  ~RowPool();
  RowPool(const RowPool&) = delete;
  RowPool& operator=(const RowPool&) = delete;

  /// Calls row(0) .. row(rows-1), in any order, and returns when all are done; the first exception
  /// is rethrown.
  void Run(std::size_t rows, const std::function<void(std::size_t)>& row);

 private:
  void Serve(const std::function<void()>& start);
  void Work(std::unique_lock<std::mutex>* lock);

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  // All guarded by mutex_.
  const std::function<void(std::size_t)>* row_ = nullptr;
  std::size_t rows_ = 0, next_ = 0, running_ = 0;
  std::exception_ptr failure_;
  bool stop_ = false;

  std::vector<std::thread> threads_;
};

}  // namespace prospect::model
