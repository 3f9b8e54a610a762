// The command `rheometry`, and a case with heat around the table that it gives.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "host/program/program.hpp"

namespace slagflow::testing_tools {

struct Said {
  int code;
  std::string out, err;
};

inline Said rheometry_command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"slagflow", "rheometry"});
  std::vector<const char*> argv;
  for (const std::string& a : arguments) argv.push_back(a.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = run_program(static_cast<int>(argv.size()), argv.data());
  std::fflush(stdout);
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

inline std::string hot_case_with(const std::string& fluid) {
  return "[case]\nname = \"x\"\n[resolution]\nspacing = 1e-3\n[thermal]\n" + fluid +
         "[[region]]\nshapes = [{shape = \"box\", min = [0, 0, 0], max = [0.01, 0.01, 0.01]}]\n"
         "temperature = 1773\n"
         "[domain]\nmin = [0, 0, 0]\nmax = [0.01, 0.01, 0.01]\n[output]\nend_time = 1\n";
}

}  // namespace slagflow::testing_tools
