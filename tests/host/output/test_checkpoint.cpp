#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "backend/error.hpp"
#include "host/case/case.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/measures/measure_front.hpp"
#include "host/output/checkpoint_store.hpp"
#include "host/output/history.hpp"
#include "host/output/snapshot_writer.hpp"
#include "host/program/info.hpp"
#include "host/run/run_interrupt.hpp"
#include "host/temp_folder.hpp"
#include "host/tiny_case.hpp"

namespace slagflow {
namespace {

using testing::HasSubstr;
using testing_tools::read_text_file;
using testing_tools::TempFolder;

Checkpoint sample(std::int64_t step) {
  Checkpoint c;
  c.texts = {{"case_text", "[case]\nname = \"x\"\n"}, {"precision", "float"}};
  c.run.time = 0.25;
  c.run.steps = step;
  c.run.history_bytes = 12345678901;
  c.run.most_in_sheets = 7, c.run.time_of_most_in_sheets = 0.25;
  c.run.most_in_walls = 12, c.run.deepest_in_wall = 1.25;
  c.run.measures = {1.5, std::numeric_limits<double>::quiet_NaN(), -0.0};
  SavedArray position{"position", 24, std::vector<std::byte>(24 * 700)};
  for (std::size_t k = 0; k < position.bytes.size(); ++k) position.bytes[k] = static_cast<std::byte>(k * k);
  c.state = {position, {"none", 4, {}}};
  return c;
}

std::string error_of(const std::string& path) {
  try {
    read_checkpoint(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

TEST(Checkpoint, ComesBackToTheBit) {
  const TempFolder folder;
  const Checkpoint written = sample(7);
  CheckpointStore(folder.path()).write(written);
  const Checkpoint read = read_checkpoint(folder / "checkpoint.h5");
  EXPECT_EQ(read.text("case_text"), written.text("case_text"));
  EXPECT_EQ(read.run.time, 0.25);
  EXPECT_EQ(read.run.steps, 7);
  EXPECT_EQ(read.run.recorded_step, -1);
  EXPECT_EQ(read.run.history_bytes, 12345678901);
  EXPECT_EQ(read.run.most_in_sheets, 7);
  EXPECT_EQ(read.run.time_of_most_in_sheets, 0.25);
  EXPECT_EQ(read.run.most_in_walls, 12);
  EXPECT_EQ(read.run.deepest_in_wall, 1.25);
  ASSERT_EQ(read.run.measures.size(), 3u);
  EXPECT_TRUE(std::isnan(read.run.measures[1]));
  EXPECT_TRUE(std::signbit(read.run.measures[2]));
  ASSERT_EQ(read.state.size(), 2u);
  for (const SavedArray& array : read.state) {
    const SavedArray& before = written.state[array.name == "position" ? 0 : 1];
    EXPECT_EQ(array.name, before.name);
    EXPECT_EQ(array.element_size, before.element_size);
    EXPECT_EQ(array.bytes, before.bytes);
  }
}

TEST(Checkpoint, RecognisesAFlippedBitAnywhere) {
  const TempFolder folder;
  CheckpointStore(folder.path()).write(sample(7));
  const std::string path = folder / "checkpoint.h5", sound = read_text_file(path);
  for (std::size_t at = 0; at < sound.size(); at += 97) {
    std::string damaged = sound;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    write_text_file(path, damaged);
    EXPECT_THAT(error_of(path), HasSubstr("checkpoint.h5")) << "byte " << at;
  }
  std::string last = sound;
  last.back() = static_cast<char>(last.back() ^ 1);
  write_text_file(path, last);
  EXPECT_THAT(error_of(path), HasSubstr("is damaged"));
}

TEST(Checkpoint, RecognisesTruncationAnywhere) {
  const TempFolder folder;
  CheckpointStore(folder.path()).write(sample(7));
  const std::string path = folder / "checkpoint.h5", sound = read_text_file(path);
  for (std::size_t size = 0; size < sound.size(); size += 211) {
    write_text_file(path, sound.substr(0, size));
    EXPECT_THAT(error_of(path), HasSubstr("is truncated")) << "size " << size;
  }
  write_text_file(path, sound.substr(0, sound.size() - 1));
  EXPECT_THAT(error_of(path), HasSubstr("is truncated"));
}

// Whoever changes an array and renews the seal is found out by the array's own checksum.
TEST(Checkpoint, RecognisesAChangedArrayUnderAGoodSeal) {
  const TempFolder folder;
  CheckpointStore(folder.path()).write(sample(7));
  const std::string path = folder / "checkpoint.h5";
  std::string bytes = read_text_file(path);
  const SavedArray position = sample(7).state[0];
  const std::string row(reinterpret_cast<const char*>(position.bytes.data()) + 24, 24);
  const std::size_t at = bytes.find(row);
  ASSERT_NE(at, std::string::npos);
  bytes[at] = static_cast<char>(bytes[at] ^ 1);
  const std::uint64_t sum = checksum(bytes.data(), bytes.size() - 16);
  std::memcpy(&bytes[bytes.size() - 8], &sum, sizeof sum);
  write_text_file(path, bytes);
  EXPECT_THAT(error_of(path), HasSubstr("array 'position' is damaged"));
}

TEST(CheckpointStore, KeepsThePreviousOne) {
  const TempFolder folder;
  const CheckpointStore store(folder.path());
  for (int step : {1, 2, 3}) store.write(sample(step));
  EXPECT_EQ(read_checkpoint(folder / "checkpoint.h5").run.steps, 3);
  EXPECT_EQ(read_checkpoint(folder / "checkpoint.previous.h5").run.steps, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
}

TEST(CheckpointStore, FallsBackOnThePreviousOneAndSaysWhy) {
  const TempFolder folder;
  const CheckpointStore store(folder.path());
  for (int step : {1, 2}) store.write(sample(step));
  write_text_file(folder / "checkpoint.h5", "rubbish");
  const FoundCheckpoint found = store.read_newest();
  EXPECT_EQ(found.checkpoint.run.steps, 1);
  ASSERT_EQ(found.damaged.size(), 1u);
  EXPECT_THAT(found.damaged[0], HasSubstr("checkpoint.h5: is truncated"));

  store.set_damaged_aside();
  store.write(sample(3));
  EXPECT_EQ(read_checkpoint(folder / "checkpoint.previous.h5").run.steps, 1);
}

// Killed between the two renames.
TEST(CheckpointStore, UsesThePreviousOneWhereItIsAlone) {
  const TempFolder folder;
  const CheckpointStore store(folder.path());
  store.write(sample(1));
  std::filesystem::rename(folder / "checkpoint.h5", folder / "checkpoint.previous.h5");
  EXPECT_EQ(store.read_newest().checkpoint.run.steps, 1);
}

TEST(CheckpointStore, NamesAllReasonsWhenNoneIsSound) {
  const TempFolder folder;
  const CheckpointStore store(folder.path());
  try {
    store.read_newest();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("holds no checkpoint.h5"));
  }
  write_text_file(folder / "checkpoint.h5", "rubbish");
  write_text_file(folder / "checkpoint.previous.h5", "");
  try {
    store.read_newest();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("checkpoint.h5: is"));
    EXPECT_THAT(error.what(), HasSubstr("checkpoint.previous.h5: is"));
  }
}

// A limit on the size of files stands for a full disk.
int write_on_full_disk(const CheckpointStore& store, rlim_t bytes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
  try {
    store.write(sample(3));
  } catch (const Error& error) {
    return std::strstr(error.what(), "checkpoint.h5.tmp: File too large") != nullptr ? 0 : 1;
  }
  return 2;
}

TEST(CheckpointStore, FullDiskLeavesWhatIsThere) {
  const TempFolder folder;
  const CheckpointStore store(folder.path());
  for (int step : {1, 2}) store.write(sample(step));
  const std::string newest = read_text_file(folder / "checkpoint.h5");
  const std::string previous = read_text_file(folder / "checkpoint.previous.h5");
  for (std::size_t full = 0; full < newest.size(); full += newest.size() / 10) {
    const pid_t child = fork();
    if (child == 0) _exit(write_on_full_disk(store, full));
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "full at " << full << ": " << status;
    EXPECT_EQ(read_text_file(folder / "checkpoint.h5"), newest);
    EXPECT_EQ(read_text_file(folder / "checkpoint.previous.h5"), previous);
    EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
  }
}

TEST(CheckpointCase, IntervalIsReadWrittenAndChecked) {
  EXPECT_EQ(parse_case(testing_tools::tiny_case(), "t.toml").output.checkpoint_interval, 300);
  const Case c = parse_case(testing_tools::tiny_case(), "t.toml", {"output.checkpoint_interval=12.5"});
  EXPECT_EQ(parse_case(to_toml(c), "u.toml").output.checkpoint_interval, 12.5);
  EXPECT_THROW(parse_case(testing_tools::tiny_case(), "t.toml", {"output.checkpoint_interval=-1"}),
               InputError);
}

TEST(HistoryFile, GoesOnBehindWhatACheckpointKnows) {
  const TempFolder folder;
  const std::string path = folder / "h.csv";
  HistoryEnd known;
  {
    HistoryFile history(path, {"a", "b"});
    history.write({1, 2});
    known = history.end();
    history.write({3, 4});
  }
  EXPECT_EQ(known.lines, 1);
  HistoryFile again(path, {"a", "b"}, known);
  again.write({5, 6});
  EXPECT_EQ(read_text_file(path), "a,b\n1,2\n5,6\n");
  EXPECT_EQ(again.end().lines, 2);
  EXPECT_EQ(again.end().bytes, 12);
}

TEST(HistoryFile, RefusesToGoOnWhereLinesAreMissingOrColumnsDiffer) {
  const TempFolder folder;
  const std::string path = folder / "h.csv";
  HistoryFile(path, {"a", "b"}).write({1, 2});
  EXPECT_THROW(HistoryFile(path, {"a", "b"}, HistoryEnd{2, 12}), Error);
  EXPECT_THROW(HistoryFile(path, {"a", "c"}, HistoryEnd{1, 8}), Error);
  EXPECT_EQ(read_text_file(path), "a,b\n1,2\n");
}

TEST(ArrivalClock, GoesOnFromItsState) {
  ArrivalClock clock(0.5), arrived(0.5);
  clock.update(1, 0.25);
  ArrivalClock again(0.5);
  again.restore(clock.state());
  EXPECT_TRUE(again.update(2, 0.75));
  EXPECT_DOUBLE_EQ(again.arrival().value(), 1.5);
  arrived.restore(again.state());
  EXPECT_FALSE(arrived.update(3, 1));
  EXPECT_DOUBLE_EQ(arrived.arrival().value(), 1.5);
}

TEST(Measures, RefuseTheStateOfOtherMeasures) {
  const Case c = parse_case(testing_tools::tiny_case(), "t.toml");
  Measures measures(c, build_setup(c).setup);
  EXPECT_THROW(measures.restore({1, 2, 3}), Error);
}

TEST(InterruptGuard, TellsARequestForACheckpointOnce) {
  InterruptGuard guard;
  EXPECT_FALSE(guard.take_checkpoint_request());
  raise(SIGUSR1);
  EXPECT_TRUE(guard.take_checkpoint_request());
  EXPECT_FALSE(guard.take_checkpoint_request());
  EXPECT_FALSE(guard.requested());
}

TEST(Info, DescribesACheckpointAndRefusesADamagedOne) {
  const TempFolder folder;
  CheckpointStore(folder.path()).write(sample(7));
  const std::string text = describe_file(folder / "checkpoint.h5");
  for (const char* part : {"precision: float", "time: 0.25 s, step 7", "position      700 of 24 bytes"})
    EXPECT_THAT(text, HasSubstr(part));
  std::fstream file(folder / "checkpoint.h5", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-30, std::ios::end) << "###";
  file.close();
  EXPECT_THROW(describe_file(folder / "checkpoint.h5"), InputError);
}

}  // namespace
}  // namespace slagflow
