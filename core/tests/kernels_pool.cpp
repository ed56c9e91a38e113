// Numbers that are shared out among workers: each comes once, and what goes wrong comes back to the caller.
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <thread>

#include "pendula/kernels/pool.hpp"
#include "requests.hpp"

using namespace requests;

namespace {

std::vector<std::unique_ptr<pool>> pools() {
  std::vector<std::unique_ptr<pool>> all;
  all.push_back(caller_alone());
  all.push_back(threads(1));
  all.push_back(threads(3));
  return all;
}

// Until it is told to stop.
void wait(shared_work& work) {
  while (work.go_on()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(kernels)

BOOST_AUTO_TEST_CASE(each_number_is_shared_out_once) {
  for (const auto& workers : pools()) {
    std::vector<std::atomic<int>> taken(1000), called(workers->workers());
    const bool complete = workers->share_out(taken.size(), always, [&](std::size_t worker, shared_work& work) {
      ++called[worker];
      for (std::size_t n; (n = work.next()) != no_more_work; work.done()) ++taken[n];
    });
    BOOST_TEST(complete);
    for (const auto& each : taken) BOOST_TEST_REQUIRE(each == 1);
    for (const auto& each : called) BOOST_TEST(each == 1);
    std::atomic<bool> none{true};
    BOOST_TEST(workers->share_out(0, never, [&](std::size_t, shared_work& work) {
      if (work.next() != no_more_work) none = false;
    }));
    BOOST_TEST(none);
  }
  BOOST_TEST(threads(0)->workers() == 1u);
}

BOOST_AUTO_TEST_CASE(a_watcher_that_says_false_ends_all_workers) {
  for (const auto& workers : pools()) {
    double done = -1.0;
    const watcher once = [&](double part) {
      done = part;
      return false;
    };
    std::atomic<bool> more{false};
    const bool complete = workers->share_out(4, once, [&](std::size_t, shared_work& work) {
      if (work.next() == 0) work.done();
      wait(work);
      if (work.next() != no_more_work) more = true;
    });
    BOOST_TEST(!complete);
    BOOST_TEST(!more);
    BOOST_TEST(done == 0.25);
  }
}

BOOST_AUTO_TEST_CASE(an_exception_in_a_worker_is_thrown_again) {
  for (const auto& workers : pools())
    BOOST_CHECK_THROW(workers->share_out(3, always,
                                         [](std::size_t worker, shared_work& work) {
                                           if (worker == 0) throw std::length_error("of the first worker");
                                           wait(work);  // it is told to stop
                                         }),
                      std::length_error);
}

BOOST_AUTO_TEST_CASE(an_exception_of_the_watcher_ends_all_workers_and_comes_through) {
  const watcher throws = [](double) -> bool { throw std::domain_error("of the watcher"); };
  for (const auto& workers : pools())
    BOOST_CHECK_THROW(workers->share_out(3, throws, [](std::size_t, shared_work& work) { wait(work); }),
                      std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
