// The command line as the shell and the manual see it.
#pragma once

#include <string>
#include <vector>

namespace slagflow {

struct CommandOption {
  std::string names;  // "-o,--output", or of a positional one its name
  std::string type;   // of its value; empty: a flag
  std::string meaning;
  bool positional = false;
};
struct Command {
  std::string name, meaning;
  std::vector<CommandOption> options;
};
struct CommandLine {
  std::string meaning;
  std::vector<Command> commands;
};

// For bash: commands, options, files, the keys of --set and of help.
std::string bash_completion(const CommandLine&);

// slagflow(1), in roff.
std::string man_page(const CommandLine&, const std::string& version);

}  // namespace slagflow
