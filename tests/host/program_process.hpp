// The program as a process of its own, to be signalled and killed.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace slagflow::testing_tools {

class ProgramProcess {
 public:
  // What it says goes to the file `output`.
  ProgramProcess(std::vector<std::string> arguments, const std::string& output,
                 const std::string& program = SLAGFLOW_PROGRAM) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    if (posix_spawn(&id_, program.c_str(), &files, nullptr, argv.data(), environ) != 0) id_ = -1;
    posix_spawn_file_actions_destroy(&files);
  }
  ~ProgramProcess() {
    if (id_ <= 0) return;
    send(SIGKILL);
    wait();
  }
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;

  void send(int signal) const {
    if (id_ > 0) kill(id_, signal);
  }
  bool runs() {
    if (id_ > 0 && waitpid(id_, &status_, WNOHANG) == id_) id_ = 0;
    return id_ > 0;
  }
  // Waits for the end: the exit status, 128 and the signal when killed, -1 when it was never started.
  int wait() {
    if (id_ < 0) return -1;
    if (id_ > 0) waitpid(id_, &status_, 0);
    id_ = 0;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  }

 private:
  pid_t id_ = -1;
  int status_ = 0;
};

// Looks every millisecond, up to a minute, whether something has come true.
template <class Condition>
bool wait_until(Condition&& condition) {
  for (int k = 0; k < 60000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace slagflow::testing_tools
