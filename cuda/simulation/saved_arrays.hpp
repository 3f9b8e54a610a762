// How the arrays and numbers of a simulation come into a saved state, and back. A header for .cu files.
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "backend/error.hpp"
#include "simulation/simulation_state.hpp"

namespace slagflow {

inline constexpr const char* numbers_name = "numbers";

// One pass over all that is saved serves both ways, so that they cannot differ. Single numbers go into an
// array of their own, in the order in which they are visited.
class Saver {
 public:
  explicit Saver(SavedState& state) : state_(state) {}
  Saver(SavedState& state, const SavedRows& rows) : state_(state), rows_(rows) {}

  // What ranks have a part each of is whole on the first one.
  template <class T>
  void of_fluid(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows_.fluid);
  }
  template <class T>
  void of_walls(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows_.walls);
  }
  template <class T>
  void of_cells(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows_.cells);
  }
  template <class T>
  void of_rows(const char* name, std::vector<T>& host) {
    std::vector<T> all = ranks().gathered_on_first(host);
    values(name, all);
  }
  template <class T>
  void of_one_rank_each(const char* name, Buffer<T>& buffer) {
    std::vector<T> host;
    buffer.download(host);
    ranks().join(host.data(), host.size() * sizeof(T));
    values(name, host);
  }

  template <class T>
  void array(const char* name, Buffer<T>& buffer) {
    std::vector<T> host;
    buffer.download(host);
    values(name, host);
  }
  template <class T>
  void values(const char* name, std::vector<T>& host) {
    SavedArray saved{name, sizeof(T), std::vector<std::byte>(host.size() * sizeof(T))};
    if (!host.empty()) std::memcpy(saved.bytes.data(), host.data(), saved.bytes.size());
    state_.push_back(std::move(saved));
  }
  template <class T>
  void as_many(const char* name, Buffer<T>& buffer) {
    array(name, buffer);
  }
  template <class T>
  void as_many(const char* name, std::vector<T>& host) {
    values(name, host);
  }
  template <class T>
  void number(T& value) {
    numbers_.push_back(static_cast<double>(value));
  }
  void end() { values(numbers_name, numbers_); }

 private:
  template <class T>
  void own_part(const char* name, const Buffer<T>& buffer, const PartOfRows& part) {
    std::vector<T> host;
    buffer.download(host);
    host.resize(static_cast<std::size_t>(part.own));
    of_rows(name, host);
  }

  SavedState& state_;
  SavedRows rows_;
  std::vector<double> numbers_;
};

class Restorer {
 public:
  explicit Restorer(const SavedState& state, const char* numbers = numbers_name) : state_(state) {
    values(numbers, numbers_);
  }

  // Of what ranks have a part each of, that of this rank.
  SavedRows rows;
  template <class T>
  void of_fluid(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows.fluid);
  }
  template <class T>
  void of_walls(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows.walls);
  }
  template <class T>
  void of_cells(const char* name, Buffer<T>& buffer) {
    own_part(name, buffer, rows.cells);
  }
  template <class T>
  void of_rows(const char* name, std::vector<T>& host) const {
    values(name, host);
  }
  template <class T>
  void of_one_rank_each(const char* name, Buffer<T>& buffer) {
    as_many(name, buffer);  // all of it on all ranks
  }

  template <class T>
  void array(const char* name, Buffer<T>& buffer) {
    std::vector<T> host;
    values(name, host);
    buffer.upload(host);
  }
  template <class T>
  void values(const char* name, std::vector<T>& host) const {
    for (const SavedArray& saved : state_) {
      if (saved.name != name) continue;
      if (saved.element_size != sizeof(T) || saved.bytes.size() % sizeof(T) != 0)
        throw Error("checkpoint: array '" + saved.name + "' has elements of " +
                    std::to_string(saved.element_size) + " bytes, this build has " +
                    std::to_string(sizeof(T)));
      host.resize(saved.bytes.size() / sizeof(T));
      if (!host.empty()) std::memcpy(host.data(), saved.bytes.data(), saved.bytes.size());
      return;
    }
    throw Error("checkpoint: array '" + std::string(name) + "' is missing");
  }
  // What the case decides the number of.
  template <class T>
  void as_many(const char* name, Buffer<T>& buffer) {
    const Offset size = buffer.size();
    array(name, buffer);
    require_fit(buffer.size() == size);
  }
  template <class T>
  void as_many(const char* name, std::vector<T>& host) {
    const std::size_t size = host.size();
    values(name, host);
    require_fit(host.size() == size);
  }
  template <class T>
  void number(T& value) {
    require_fit(next_ < numbers_.size());
    const double saved = numbers_[next_++];
    constexpr double exact = 9007199254740992;  // as are whole numbers up to there
    const double largest = smaller(exact, static_cast<double>(std::numeric_limits<T>::max()));
    if (std::is_integral_v<T> && !(std::abs(saved) <= largest)) refuse_numbers();
    value = static_cast<T>(saved);
  }
  void end() const { require_fit(next_ == numbers_.size()); }

  static void require_fit(bool fits) {
    if (!fits) throw Error("checkpoint: its arrays do not belong to this case");
  }
  [[noreturn]] static void refuse_numbers() { throw Error("checkpoint: its numbers are not those of a run"); }

 private:
  template <class T>
  void own_part(const char* name, Buffer<T>& buffer, const PartOfRows& part) {
    std::vector<T> host;
    values(name, host);
    require_fit(static_cast<Offset>(host.size()) == part.all);
    buffer.upload({host.begin() + part.first, host.begin() + part.first + part.own});
  }

  const SavedState& state_;
  std::vector<double> numbers_;
  std::size_t next_ = 0;
};

}  // namespace slagflow
