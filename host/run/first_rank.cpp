#include "host/run/first_rank.hpp"

#include <cstdint>
#include <new>
#include <string>

#include "backend/error.hpp"
#include "backend/ranks.hpp"

namespace slagflow {
namespace {

enum class Ending : std::uint8_t { well, bad_input, error };

struct Verdict {
  Ending ending = Ending::well;
  std::string reason;
};

Verdict attempt(const std::function<void()>& action) {
  try {
    action();
    return {};
  } catch (const InputError& error) {
    return {Ending::bad_input, error.what()};
  } catch (const std::exception& error) {
    return {Ending::error, error.what()};
  }
}

}  // namespace

void on_first_rank(const std::function<void()>& action) {
  if (!ranks().several()) return action();
  ranks().added(0);  // until all have come here
  Verdict verdict;
  if (ranks().first()) verdict = attempt(action);
  std::uint64_t length = verdict.reason.size();
  ranks().share(&verdict.ending, sizeof verdict.ending);
  if (verdict.ending == Ending::well) return;
  ranks().share(&length, sizeof length);
  verdict.reason.resize(length);
  ranks().share(verdict.reason.data(), length);
  if (verdict.ending == Ending::bad_input) throw InputError(verdict.reason);
  throw Error(verdict.reason);
}

}  // namespace slagflow
