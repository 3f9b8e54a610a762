// The one kind of exception: names the object and the value.
#pragma once

#include <stdexcept>
#include <string>

namespace slagflow {

// A run that cannot go on (exit code 1).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Bad input or arguments (exit code 2).
class InputError : public Error {
 public:
  using Error::Error;
};

// What only one of several processes has seen: memory or a device that failed.
class LocalError : public Error {
 public:
  using Error::Error;
};

}  // namespace slagflow
