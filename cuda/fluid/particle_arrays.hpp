// Arrays with one element a particle. Each is declared once, as a member of the arrays it belongs to: name,
// type, unit, meaning, and what becomes of it. What is done to all of them walks along the list that this
// makes.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "backend/buffer.hpp"
#include "backend/halo.hpp"
#include "backend/plane_table.hpp"
#include "fluid/math.hpp"

namespace slagflow {

// What becomes of an array, besides being as long as there are particles.
enum class Fate : unsigned {
  set_anew = 0,  // in each step before it is read, so that it need not follow
  sorted = 1,    // goes along when particles are sorted
  saved = 2,     // goes into checkpoints
  shown = 4,     // goes to the host for snapshots
  optional = 8   // takes no memory in runs that never fill it
};
constexpr Fate operator|(Fate a, Fate b) {
  return static_cast<Fate>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Fate all, Fate one) {
  return (static_cast<unsigned>(all) & static_cast<unsigned>(one)) != 0;
}

struct ParticleField {
  const char* name;  // unique among all that is saved
  const char* unit;
  const char* meaning;
  Fate fate;
};

template <class T>
class ParticleArray;

// As many particles as `count`, in memory for as many as `capacity`.
class ParticleArrays {
 public:
  explicit ParticleArrays(Context& c) : context(c), live_(c, "number of particles", 1), planes_(c) {
    count_anew(0);
  }
  ParticleArrays(const ParticleArrays&) = delete;
  ParticleArrays& operator=(const ParticleArrays&) = delete;

  Context& context;
  Rows count;
  Index capacity() const { return capacity_; }
  // Those behind them that belong to other ranks included.
  Index local() const { return count.halo ? halo_.rows() : count.now; }

  // What is there stays, up to the new count. Beyond the capacity that grows by a quarter at least, so that
  // few of the times that particles come take memory.
  void resize(Index n) { resize(n, n); }
  // They are a part of all from now on, with copies of others behind them.
  void resize(const Halo& halo) {
    halo_ = halo;
    resize(halo.own, halo.rows());
    count.halo = &halo_;
  }

  // Sums go by these planes of all particles from now on. Those that come later are behind them; when some
  // go, the planes do.
  void put_in_planes(const PlaneStarts& starts) {
    planes_.find(starts, capacity_);
    in_planes_ = count;
    count.planes = planes_.view();
  }

  // Calls visit(array) for each, in the order of their declaration.
  template <class Visit>
  void each(Visit visit) const {
    for (const Any& any : list_) std::visit([&](auto* array) { visit(*array); }, any);
  }
  // The same for those of a fate, where they hold anything.
  template <class Visit>
  void each(Fate fate, Visit visit) const {
    each([&](auto& array) {
      if (has(array.field.fate, fate) && !array.absent()) visit(array);
    });
  }

 private:
  template <class T>
  friend class ParticleArray;
  using Any = std::variant<ParticleArray<Vec3d>*, ParticleArray<Quad>*, ParticleArray<double>*,
                           ParticleArray<float>*, ParticleArray<Index>*, ParticleArray<std::uint8_t>*>;
  void count_anew(Index n) {
    live_.upload({n});
    if (n < in_planes_) in_planes_ = 0;
    count = {n, capacity_, live_.span().data, in_planes_ > 0 ? planes_.view() : Planes{}};
  }

  void resize(Index own, Index local);

  std::vector<Any> list_;
  Halo halo_;
  Index capacity_ = 0;
  Buffer<Index> live_;
  PlaneTable planes_;
  Index in_planes_ = 0;
};

template <class T>
class ParticleArray : public Buffer<T> {
 public:
  ParticleArray(ParticleArrays& owner, const ParticleField& f) : Buffer<T>(owner.context, f.name), field(f) {
    owner.list_.push_back(this);
  }
  ParticleArray(const ParticleArray&) = delete;
  ParticleArray& operator=(const ParticleArray&) = delete;

  const ParticleField field;

  // An optional array is there from when it is filled, or said to be used: there may be no particles yet.
  void use() { used_ = true; }
  bool absent() const { return has(field.fate, Fate::optional) && !used_ && this->size() == 0; }

 private:
  bool used_ = false;
};

inline void ParticleArrays::resize(Index own, Index local) {
  if (local > capacity_) capacity_ = larger(local, capacity_ + capacity_ / 4);
  if (own != count || capacity_ != count.room || count.halo) count_anew(own);
  each([&](auto& array) {
    if (array.absent()) return;
    array.reserve(capacity_);
    array.resize(local);
  });
}

}  // namespace slagflow
