// Threads that share out numbered work, while Python is looked up for now and then.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "attendance.hpp"

namespace pendula_python {

class pool {
 public:
  explicit pool(std::size_t count) : count_(count) {}

  // What the threads ask: the next number, or `none`, and whether to go on.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t next() {
    const std::size_t n = next_.fetch_add(1, std::memory_order_relaxed);
    return n < count_ && go_on() ? n : none;
  }
  bool go_on() const { return !stopped_.load(std::memory_order_relaxed); }
  void done() { done_.fetch_add(1, std::memory_order_relaxed); }

  // Runs work(0), work(1) … in a thread each; without the GIL, which is taken to attend to Python: where that raises,
  // or a thread does, all stop. False where Python has raised.
  template <class Work>
  bool run(std::size_t threads, const attendance& attending, Work&& work) {
    bool well = true;
    std::vector<std::jthread> all;
    working_ = threads;
    for (std::size_t i = 0; i < threads; ++i) all.emplace_back([this, &work, i] { guarded(work, i); });
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(50), [this] { return working_ == 0; })) {
      lock.unlock();
      if (well && !attending(static_cast<double>(done_.load()) / static_cast<double>(count_))) {
        well = false;
        stopped_ = true;
      }
      lock.lock();
    }
    lock.unlock();
    all.clear();
    if (error_) std::rethrow_exception(error_);
    return well;
  }

 private:
  template <class Work>
  void guarded(Work& work, std::size_t i) {
    std::exception_ptr error;
    try {
      work(i);
    } catch (...) {
      error = std::current_exception();
      stopped_ = true;
    }
    const std::lock_guard lock(mutex_);
    if (error) error_ = error;
    if (--working_ == 0) ended_.notify_one();
  }

  std::size_t count_, working_ = 0;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  std::exception_ptr error_;
};

}  // namespace pendula_python
