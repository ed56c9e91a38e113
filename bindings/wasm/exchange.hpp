// What crosses the border: one list of numbers in, lists of numbers out, and a fault as text. The page's side of it is
// web/src/core/instance.ts.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pendula/kernels/check.hpp"
#include "pendula/kernels/request.hpp"
#include "pendula/kernels/wrong_call.hpp"

// A function that the page calls; it gives 1 where it refuses what is asked, and 0 where answers stand in the lists.
#define PENDULA_EXPORT(name) extern "C" __attribute__((export_name(#name))) int name()

namespace pendula_wasm {

// Reads what is asked, in its order; a list is its length and its numbers.
class reader {
 public:
  double number();
  bool flag() { return number() != 0.0; }
  std::size_t place(std::size_t below);  // among so many
  std::int64_t whole() { return static_cast<std::int64_t>(number()); }
  std::span<const double> list();
  std::optional<double> option();  // NaN: not given

  pendula::system_description system();
  pendula::request request();  // with its system, method, options and events
  // All that was read since the beginning.
  std::span<const double> read() const;

 private:
  std::size_t next_ = 0;
};

// Forgets the last answer, and reads what is asked.
reader asked();

// One more list of the answer, of numbers of any kind.
std::vector<double>& answer();
template <class Numbers>
void answer_with(const Numbers& numbers) {
  auto& list = answer();
  list.reserve(numbers.size());
  for (const auto each : numbers) list.push_back(static_cast<double>(each));
}

// 1, and the fault as text, where there is one.
int refused(const std::optional<pendula::fault>& found);

// Nobody waits at the same time: what is left is ended with its worker.
inline bool to_the_end(double) { return true; }

}  // namespace pendula_wasm
