#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "pendula/drive/polling.hpp"
#include "pendula/kernels/pool.hpp"

namespace pendula {

namespace {

class work_of_threads final : public shared_work {
 public:
  explicit work_of_threads(std::size_t count) : count_(count) {}

  std::size_t next() override {
    const std::size_t n = next_.fetch_add(1, std::memory_order_relaxed);
    return n < count_ && go_on() ? n : no_more_work;
  }
  void done() override { done_.fetch_add(1, std::memory_order_relaxed); }
  bool go_on() override { return !stopped_.load(std::memory_order_relaxed); }

  void stop() { stopped_ = true; }
  double part_done() const {
    return count_ == 0 ? 1.0 : static_cast<double>(done_.load()) / static_cast<double>(count_);
  }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_{0}, done_{0};
  std::atomic<bool> stopped_{false};
};

// Whatever ends the caller's wait, an exception of its watcher too, ends the work.
struct stopped_at_exit {
  work_of_threads& shared;
  ~stopped_at_exit() { shared.stop(); }
};

class thread_pool final : public pool {
 public:
  explicit thread_pool(std::size_t count) : count_(count) {}

  std::size_t workers() const override { return count_; }

  // An exception in a thread, such as memory that is not there, stops all and is thrown again here.
  bool share_out(std::size_t count, const watcher& watch, const job& work) override {
    work_of_threads shared(count);
    std::mutex mutex;
    std::condition_variable ended;
    std::exception_ptr error;
    std::size_t working = count_;
    const auto guarded = [&](std::size_t i) {
      std::exception_ptr mine;
      try {
        work(i, shared);
      } catch (...) {
        mine = std::current_exception();
        shared.stop();
      }
      const std::lock_guard lock(mutex);
      if (mine) error = mine;
      if (--working == 0) ended.notify_one();
    };
    std::vector<std::jthread> all;
    const stopped_at_exit before_they_are_joined{shared};
    for (std::size_t i = 0; i < count_; ++i) all.emplace_back(guarded, i);
    bool complete = true;
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, between_looks, [&] { return working == 0; })) {
      lock.unlock();
      if (complete && !watch(shared.part_done())) {
        complete = false;
        shared.stop();
      }
      lock.lock();
    }
    lock.unlock();
    all.clear();
    if (error) std::rethrow_exception(error);
    return complete;
  }

 private:
  std::size_t count_;
};

}  // namespace

std::unique_ptr<pool> threads(std::size_t count) { return std::make_unique<thread_pool>(count == 0 ? 1 : count); }

}  // namespace pendula
