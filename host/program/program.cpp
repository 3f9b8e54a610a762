#include "host/program/program.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "backend/device.hpp"
#include "backend/error.hpp"
#include "backend/ranks.hpp"
#include "host/case/case.hpp"
#include "host/case/case_table.hpp"
#include "host/geometry/setup_builder.hpp"
#include "host/output/provenance.hpp"
#include "host/program/command_line.hpp"
#include "host/program/info.hpp"
#include "host/program/init.hpp"
#include "host/program/key_help.hpp"
#include "host/program/rheometry_command.hpp"
#include "host/rheometry/rheometry.hpp"
#include "host/run/check.hpp"
#include "host/run/progress.hpp"
#include "host/run/run.hpp"
#include "version.hpp"

namespace slagflow {
namespace {

enum class HelpForm { text, page, schema, completion, man };

struct Arguments {
  std::string file;
  std::string topic;
  HelpForm help = HelpForm::text;
  std::string from;
  bool json = false, calibrate = false;
  std::vector<std::string> overrides;
  RunOptions run;
  RheometryOptions rheometry;
  InitOptions init;
};

// Throws Error where stdout does not take it, but where its reader has left: he has read enough.
void require_written(bool good) {
  if (!good && errno != EPIPE) throw Error(std::string("cannot write to stdout: ") + std::strerror(errno));
}

void print(const std::string& text) { require_written(std::fputs(text.c_str(), stdout) >= 0); }

std::string version_text() {
  const Provenance p = build_provenance();
  return "slagflow " + p.version + "\ncommit    " + p.commit + "\nbuild     " + p.backend + ", " +
         p.precision + ", " + p.compiler + ", " + p.build_type + "\ndevice    " + p.device + " (" +
         std::to_string(p.threads) + " threads)";
}

int report(const RunOutcome& outcome) {
  if (!outcome.folder.empty()) print("results in " + outcome.folder + "\n");
  for (const std::string& line : outcome.results) print(line + "\n");
  return outcome.exit_code();
}

const CLI::Validator above_zero = number_above_zero();

const CLI::Validator not_empty(
    [](const std::string& text) { return text.empty() ? "value \"\": allowed: a folder" : std::string(); },
    "");

int run(const Arguments& arguments) {
  if (!arguments.from.empty())
    return report(run_from({arguments.from, arguments.file, arguments.overrides}, arguments.run));
  if (arguments.file.empty())
    throw InputError("run: neither a case nor --from: allowed: CASE.toml, --from DIR[@TIME], or both");
  return report(run_case(load_case(arguments.file, arguments.overrides), arguments.run));
}

int resume(Arguments arguments) {
  arguments.run.changes = std::move(arguments.overrides);
  return report(resume_run(arguments.run));
}

int check(const Arguments& arguments) {
  std::optional<StartProgress> progress(Verbosity::normal);
  const BuiltCase built = build_setup(load_case(arguments.file, arguments.overrides), progress->stage());
  progress->stage()("timing this machine");
  const MachineSpeed machine = machine_speed(built.setup.dimensions, arguments.calibrate);
  progress->stage()("looking at fluid and walls");
  const CaseCheck found = check_case(built, machine);
  progress.reset();
  if (arguments.json)
    print(Json::object().set("case", arguments.file).set("valid", true).set("check", to_json(found)).text() +
          "\n");
  else
    print(arguments.file + ": valid\n" + to_text(found));
  return 0;
}

int info(const Arguments& arguments) {
  print(describe_file(arguments.file));
  return 0;
}

int init(Arguments arguments) {
  arguments.init.terminal = isatty(STDIN_FILENO) != 0;
  print(init_case(arguments.init, std::cin, std::cout));
  return 0;
}

int rheometry(const Arguments& arguments) {
  run_rheometry(arguments.rheometry);
  return 0;
}

CommandLine command_line(const CLI::App& app) {
  CommandLine line{app.get_description(), {}};
  for (const CLI::App* command : app.get_subcommands({})) {
    line.commands.push_back({command->get_name(), command->get_description(), {}});
    for (const CLI::Option* option : command->get_options()) {
      const bool positional = option->get_positional(), flag = option->get_items_expected_max() == 0;
      const std::string type = option->get_type_name();
      line.commands.back().options.push_back({option->get_name(positional, !positional),
                                              flag ? "" : type.substr(0, type.find(':')),
                                              option->get_description(), positional});
    }
  }
  return line;
}

int help(const Arguments& arguments, const CLI::App& app) {
  switch (arguments.help) {
    case HelpForm::page:
      print(key_page());
      return 0;
    case HelpForm::schema:
      print(key_schema());
      return 0;
    case HelpForm::completion:
      print(bash_completion(command_line(app)));
      return 0;
    case HelpForm::man:
      print(man_page(command_line(app), SLAGFLOW_VERSION));
      return 0;
    default:
      break;
  }
  for (const CLI::App* command : app.get_subcommands({}))
    if (command->get_name() == arguments.topic) return print(command->help()), 0;
  print(key_help(arguments.topic));
  return 0;
}

CLI::Option* add_case(CLI::App* command, Arguments& arguments) {
  return command->add_option("case", arguments.file, "case file")->type_name("CASE.toml");
}

void add_set(CLI::App* command, Arguments& arguments, const char* what) {
  command->add_option("--set", arguments.overrides, what)->allow_extra_args(false)->type_name("KEY=VALUE");
}

constexpr const char* set_a_key = "set a key of the case, as fluid.slag.yield_stress=5";

// Those of `run` and `resume`.
void add_loop_options(CLI::App* command, RunOptions& run) {
  command->add_option("--threads", run.threads, "threads of the CPU build")->check(CLI::Range(1, 4096));
  command->add_option("--until", run.until, "end at this simulated time [s]")->check(above_zero);
  command->add_flag_callback(
      "--quiet", [&run] { run.verbosity = Verbosity::quiet; }, "only warnings and errors on stderr");
  command->add_flag("--time-parts", run.time_parts,
                    "CUDA build: time each part of a step, which makes it slower");
}

void add_run_options(CLI::App* command, RunOptions& run) {
  command->add_option("-o,--output", run.folder, "folder of the run (default: runs/<case name>)")
      ->check(not_empty)
      ->type_name("DIR");
  command->add_flag_callback(
      "--overwrite", [&run] { run.overwrite = Overwrite::replace; }, "replace an earlier run in the folder");
}

CLI::App* add_help(CLI::App& app, Arguments& arguments) {
  CLI::App* const command = app.add_subcommand("help", "what the keys of a case file mean");
  command->add_option("topic", arguments.topic, "key, table or command; without it all tables")
      ->type_name("KEY");
  const auto form = [&](const char* name, HelpForm value, const char* what) {
    command->add_flag_callback(
        name, [&arguments, value] { arguments.help = value; }, what);
  };
  form("--page", HelpForm::page, "all keys, as Markdown");
  form("--schema", HelpForm::schema, "a JSON schema of case files, for editors");
  form("--completion", HelpForm::completion, "completion of this command line for bash");
  form("--man", HelpForm::man, "the manual page");
  return command;
}

CLI::App* add_run(CLI::App& app, Arguments& arguments) {
  CLI::App* const command = app.add_subcommand("run", "run a case");
  add_case(command, arguments);
  add_set(command, arguments, set_a_key);
  command
      ->add_option(
          "--from", arguments.from,
          "start in the state of another run: its newest checkpoint, or what is nearest to TIME [s]; "
          "with its case unless one is given")
      ->check(not_empty)
      ->type_name("DIR[@TIME]");
  add_run_options(command, arguments.run);
  add_loop_options(command, arguments.run);
  return command;
}

CLI::App* add_resume(CLI::App& app, Arguments& arguments) {
  CLI::App* const command = app.add_subcommand("resume", "go on with a run from its checkpoint");
  command->add_option("folder", arguments.run.folder, "folder of the run")->required()->type_name("DIR");
  add_set(command, arguments, "change a key that may change in a run, as output.end_time=2");
  add_loop_options(command, arguments.run);
  return command;
}

CLI::App* add_init(CLI::App& app, InitOptions& options) {
  CLI::App* const command =
      app.add_subcommand("init", "write a commented case to begin with; on a terminal it asks for the fluid");
  command->add_option("template", options.asked, "dam, runner, pouring, slump or viscometer")
      ->type_name("TEMPLATE");
  command->add_option("--template", options.given, "the same, and nothing is asked")->type_name("TEMPLATE");
  command->add_option("-o,--output", options.output, "the case's file (default: TEMPLATE.toml)")
      ->check(not_empty)
      ->type_name("FILE");
  for (const auto& [name, value, what] :
       {std::tuple{"--density", &options.density, "of the fluid [kg/m^3]"},
        std::tuple{"--viscosity", &options.viscosity, "once it flows [Pa s]"},
        std::tuple{"--spacing", &options.spacing, "of the particles [m]"}})
    command->add_option(name, *value, what)->check(above_zero);
  command->add_option("--yield-stress", options.yield_stress, "[Pa]; 0: Newtonian")
      ->check(CLI::Range(0.0, 1e30));
  return command;
}

// A first word that is no command.
void require_command(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-' || argv[1][0] == '\0') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::string word = argv[1];
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError("command '" + shortened(word) + "': unknown: " + suggestion(word, names) +
                   "allowed: " + join(names));
}

int dispatch(int argc, const char* const* argv) {
  CLI::App app("Smoothed-particle hydrodynamics of slag with a yield stress and a free surface.", "slagflow");
  Arguments arguments;
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text, "version, commit, build and device");
  CLI::App* const run_command = add_run(app, arguments);
  CLI::App* const resume_command = add_resume(app, arguments);
  CLI::App* const check_command = app.add_subcommand("check", "validate a case and estimate its cost");
  add_case(check_command, arguments)->required();
  add_set(check_command, arguments, set_a_key);
  check_command->add_flag("--json", arguments.json, "print it as JSON, numbers in SI units");
  check_command->add_flag("--calibrate", arguments.calibrate,
                          "measure anew how fast this machine computes, which takes a second");
  CLI::App* const info_command = app.add_subcommand("info", "what a .vtkhdf file or a checkpoint holds");
  info_command->add_option("file", arguments.file, "file of a run")->required()->type_name("FILE");
  CLI::App* const init_command = add_init(app, arguments.init);
  CLI::App* const rheometry_command = add_rheometry(app, arguments.rheometry);
  CLI::App* const help_command = add_help(app, arguments);
  require_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out;
    const int status = app.exit(error, out);
    print(out.str());
    return status == 0 ? 0 : 2;
  }
  if (run_command->parsed()) return run(arguments);
  if (resume_command->parsed()) return resume(arguments);
  if (init_command->parsed()) return init(arguments);
  if (rheometry_command->parsed()) return rheometry(arguments);
  if (help_command->parsed()) return help(arguments, app);
  return check_command->parsed() ? check(arguments) : info(arguments);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  try {
    const int status = dispatch(argc, argv);
    require_written(std::fflush(stdout) == 0);
    return status;
  } catch (const InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "error: out of memory\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  return 1;
}

int run_with_others(int argc, char** argv) {
  try {
    ranks().start(argc, argv);
    if (ranks().several()) use_device_of_rank(ranks().local_rank());
  } catch (const InputError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    ranks().abort(1, error.what());
  }
  const int status = run_program(argc, argv);
  ranks().end();
  return status;
}

}  // namespace slagflow
