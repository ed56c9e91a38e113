#include <chrono>

#include "pendula/drive/polling.hpp"
#include "pendula/kernels/pool.hpp"

namespace pendula {

namespace {

// Asks the watcher itself: there is no other thread to do so.
class work_of_one final : public shared_work {
 public:
  work_of_one(std::size_t count, const watcher& watch) : count_(count), watch_(watch) {}

  std::size_t next() override { return next_ < count_ && go_on() ? next_++ : no_more_work; }
  void done() override { ++done_; }
  bool go_on() override {
    const auto now = clock::now();
    if (going_on_ && now - last_ >= between_looks) {
      last_ = now;
      going_on_ = watch_(static_cast<double>(done_) / static_cast<double>(count_));
    }
    return going_on_;
  }
  bool complete() const { return going_on_; }

 private:
  using clock = std::chrono::steady_clock;

  std::size_t count_, next_ = 0, done_ = 0;
  const watcher& watch_;
  clock::time_point last_ = clock::now();
  bool going_on_ = true;
};

class one_worker final : public pool {
 public:
  std::size_t workers() const override { return 1; }
  bool share_out(std::size_t count, const watcher& watch, const job& work) override {
    work_of_one shared(count, watch);
    work(0, shared);
    return shared.complete();
  }
};

}  // namespace

std::unique_ptr<pool> caller_alone() { return std::make_unique<one_worker>(); }

}  // namespace pendula
