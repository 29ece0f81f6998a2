#include "model/row_pool.h"

#include <exception>
#include <utility>

namespace prospect::model {

RowPool::RowPool(int threads, std::function<void()> start) {
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this, start] { Serve(start); });
}

RowPool::~RowPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void RowPool::Work(std::unique_lock<std::mutex>* lock) {
  while (next_ < rows_) {
    const std::size_t mine = next_++;
    ++running_;
    lock->unlock();
    std::exception_ptr failure;
    try {
      (*row_)(mine);
    } catch (...) {
      failure = std::current_exception();
    }
    lock->lock();
    --running_;
    if (failure && !failure_) failure_ = failure;
  }
  if (running_ == 0) done_.notify_all();
}

void RowPool::Serve(const std::function<void()>& start) {
  start();
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || next_ < rows_; });
    if (stop_) return;
    Work(&lock);
  }
}

void RowPool::Run(std::size_t rows, const std::function<void(std::size_t)>& row) {
  std::unique_lock<std::mutex> lock(mutex_);
  row_ = &row;
  rows_ = rows;
  next_ = 0;
  failure_ = nullptr;
  if (rows > 1) wake_.notify_all();
  Work(&lock);
  done_.wait(lock, [this] { return running_ == 0 && next_ >= rows_; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace prospect::model
