// A disk that is really full: file systems of memory, too small for the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/output/checkpoint_store.hpp"
#include "host/program/info.hpp"
#include "host/program_process.hpp"
#include "host/same_results.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::expect_same_results;
using testing_tools::ProgramProcess;
using testing_tools::read_text_file;
using testing_tools::TempFolder;
using testing_tools::tiny_case;

class FullDisk : public testing::Test {
 protected:
  // In a mount namespace of its own, so that nothing stays mounted.
  int shell(const std::string& script) const {
    return ProgramProcess({"-r", "-m", "sh", "-c", script}, folder_ / "said", "/usr/bin/unshare").wait();
  }
  int slagflow(const std::vector<std::string>& command) const {
    return ProgramProcess(command, folder_ / "said").wait();
  }
  std::string mount(int kib) const {
    return "mount -t tmpfs -o size=" + std::to_string(kib) + "k tmpfs " + (folder_ / "disk");
  }
  std::string said() const { return read_text_file(folder_ / "said"); }

  const TempFolder folder_;
};

TEST_F(FullDisk, EndsTheRunWithTheReasonAndItGoesOnElsewhere) {
  const std::string disk = folder_ / "disk", kept = folder_ / "kept";
  std::filesystem::create_directory(disk);
  if (shell(mount(64)) != 0) GTEST_SKIP() << "may not mount: " << said();
  std::ofstream(folder_ / "tiny.toml") << tiny_case("0.02");
  const std::string options =
      " --threads 1 --quiet --overwrite --set output.checkpoint_interval=0.2 --set resolution.spacing=1e-3"
      " --set output.interval=1e-4 --set numerics.courant=0.5";
  const std::string run = SLAGFLOW_PROGRAM " run " + (folder_ / "tiny.toml") + options + " -o ";
  ASSERT_EQ(shell(run + (folder_ / "unbroken")), 0) << said();
  // The run writes 6 MiB, and wants as much free before it begins a time step in a file.
  int resumed = 0;
  for (const int kib : {500, 7000, 8500, 10000, 11500}) {
    SCOPED_TRACE("a disk of " + std::to_string(kib) + " KiB");
    std::filesystem::remove_all(kept);
    const int status = shell(mount(kib) + " && { " + run + disk + "; status=$?; cp -a " + disk + " " + kept +
                             "; exit $status; }");
    EXPECT_EQ(status, 1) << said();
    EXPECT_THAT(said(), testing::ContainsRegex("cannot [a-z ]+ /.*/disk/[a-z.0-9]+"));
    EXPECT_THAT(said(), testing::AnyOf(HasSubstr("No space left on device"), HasSubstr("file write failed")));
    if (!std::filesystem::exists(kept + "/checkpoint.h5")) continue;
    EXPECT_THAT(describe_file(kept + "/particles.vtkhdf"), HasSubstr("time steps: "));
    ASSERT_EQ(slagflow({"resume", kept, "--threads", "1", "--quiet"}), 0) << said();
    expect_same_results(kept, folder_ / "unbroken");
    ++resumed;
  }
  EXPECT_GE(resumed, 4);
}

}  // namespace
}  // namespace slagflow
