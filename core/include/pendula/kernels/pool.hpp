// Workers that share out numbered work. Threads stand behind this interface, or, where there are none, as in a browser,
// the caller alone.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "pendula/kernels/result.hpp"

namespace pendula {

inline constexpr std::size_t no_more_work = static_cast<std::size_t>(-1);

// What a worker asks of the work that it shares with others.
struct shared_work {
  virtual std::size_t next() = 0;  // the next number, or no_more_work
  virtual void done() = 0;         // with one of them
  virtual bool go_on() = 0;        // cheap: asked often

 protected:
  ~shared_work() = default;
};

class pool {
 public:
  using job = std::function<void(std::size_t worker, shared_work&)>;

  virtual ~pool() = default;
  virtual std::size_t workers() const = 0;
  // Shares out the numbers below `count`: `work` runs once in each worker. `watch` is asked some times a second, by the
  // caller's thread, with the part of the numbers that is done; once it says false, all come to an end, and so does
  // this.
  virtual bool share_out(std::size_t count, const watcher& watch, const job& work) = 0;
};

std::unique_ptr<pool> caller_alone();
std::unique_ptr<pool> threads(std::size_t count);

}  // namespace pendula
