#include "host/program/rheometry_command.hpp"

#include <string>
#include <tuple>

#include "host/case/case_table.hpp"

namespace slagflow {
namespace {

void add_facts(CLI::App* command, SampleFacts& facts) {
  for (const auto& [name, fact, what] :
       {std::tuple{"--bob-radius", &facts.bob_radius, "of concentric cylinders [m]"},
        std::tuple{"--cup-radius", &facts.cup_radius, "of concentric cylinders [m]"},
        std::tuple{"--height", &facts.height, "of the wetted bob [m]"},
        std::tuple{"--full-scale-torque", &facts.full_scale_torque, "where torque is in per cent [N m]"},
        std::tuple{"--density", &facts.density, "of the fluid [kg/m^3]"}})
    command->add_option(name, *fact, what)->check(number_above_zero());
  command->add_option("--spindle", facts.spindle, "of Brookfield: LV-1 to LV-4, RV-1 to RV-7");
  command->add_option("--table", facts.table, "take this one of several tables in the file, from 1")
      ->check(CLI::Range(1, 10000));
  command->add_option("--name", facts.name, "of the fluid (default: the name of the file)");
  command->add_flag("--over-temperature", facts.over_temperature,
                    "the readings are viscosities over temperature, whatever else varies");
}

void add_melts(CLI::App* command, RheometryOptions& options) {
  command->add_option("--above", options.above, "over temperature: only readings of at least that [K]")
      ->check(number_above_zero());
  command
      ->add_option("--composition", options.composition,
                   "in place of a file: of a liquid slag in mass %, as \"CaO=42,SiO2=36,Al2O3=14,MgO=8\"")
      ->type_name("LIST");
  command->add_flag("--mole", options.mole, "the composition is in mole %");
  command->add_flag("--phases", options.phases,
                    "the file is of thermodynamics software: solid fraction, heat capacity, latent heat");
  command->add_option("--mass", options.mass, "of what its enthalpies in J are of [kg]")
      ->check(number_above_zero());
}

}  // namespace

CLI::Validator number_above_zero() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && above(0, "").holds(value)) return std::string();
        return "value " + text + ": allowed: " + above(0, "").text();
      },
      "");
}

CLI::App* add_rheometry(CLI::App& app, RheometryOptions& options) {
  CLI::App* const command = app.add_subcommand(
      "rheometry",
      "fit rheologies to a viscometer's readings, and melts to viscosities over temperature, to compositions "
      "and to tables of phases");
  command->add_option("file", options.file, "readings, or a table of phases")->type_name("FILE.csv");
  command
      ->add_option_function<std::string>(
          "--model", [&options](const std::string& name) { set_model(name, options); },
          "newtonian, bingham, herschel-bulkley; over temperature arrhenius, weymann, vft; of a composition "
          "urbain, riboud; or auto: the best by AICc")
      ->check(CLI::IsMember(model_names()));
  command->add_option("-o,--output", options.output, "the fluid's table; the curves go beside it")
      ->type_name("X.toml");
  add_facts(command, options.facts);
  command->add_option("--growth-exponent", options.growth_exponent, "m of the fluid's table [s]")
      ->check(number_above_zero());
  command->add_flag_callback(
      "--relative-errors", [&options] { options.errors = ErrorModel::relative; },
      "the readings are uncertain by the same share, not by the same stress");
  add_melts(command, options);
  return command;
}

}  // namespace slagflow
