#include "host/case/case_catalogue.hpp"
#include "host/program/command_line.hpp"

namespace slagflow {
namespace {

// Text in roff: no character of it is a command.
std::string roff(const std::string& text) {
  std::string out;
  if (!text.empty() && (text[0] == '.' || text[0] == '\'')) out = "\\&";
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }

// A paragraph with a tag.
std::string tagged(const std::string& tag, const std::string& more, const std::string& text) {
  return ".TP\n" + bold(tag) + (more.empty() ? "" : " " + roff(more)) + "\n" + roff(text) + "\n";
}

std::string command_text(const Command& command) {
  std::string usage = "slagflow " + command.name, options;
  for (const CommandOption& option : command.options) {
    if (option.positional) usage += " " + option.type;
    options += tagged(option.positional ? option.type : option.names, option.positional ? "" : option.type,
                      option.meaning);
  }
  return ".SS " + roff(usage) + "\n" + roff(command.meaning) + "\n" + options;
}

std::string key_text(const CatalogueKey& k) {
  std::string facts = k.type_text() + (k.unit.empty() ? "" : " [" + k.unit + "]");
  if (!k.allowed.empty()) facts += "; " + k.allowed;
  if (k.need == Need::required)
    facts += "; required";
  else if (!k.fallback.empty())
    facts += "; default " + k.fallback;
  return tagged(k.name, facts, (k.where.empty() ? "" : "With " + k.where_text() + ": ") + k.meaning);
}

std::string tables_text() {
  std::string text;
  std::vector<std::string> done;
  for (const CatalogueKey& table : catalogue().keys()) {
    if (!table.is_table()) continue;
    bool again = false;
    for (const std::string& inside : done) again = again || inside == table.inside;
    if (again) continue;
    done.push_back(table.inside);
    text += ".SS " + roff(table.inside) + "\n" + roff(table.meaning) + "\n";
    for (const CatalogueKey* k : catalogue().in(table.inside)) text += key_text(*k);
  }
  return text;
}

}  // namespace

std::string man_page(const CommandLine& line, const std::string& version) {
  std::string text =
      ".TH SLAGFLOW 1 \"\" \"slagflow " + roff(version) + "\" \"User Commands\"\n.SH NAME\nslagflow " +
      "\\- smoothed\\-particle hydrodynamics of fluids with a yield stress\n" + ".SH SYNOPSIS\n" +
      bold("slagflow") + " \\fICOMMAND\\fR [\\fIOPTION\\fR...]\n.SH DESCRIPTION\n" + roff(line.meaning) +
      "\n.SH COMMANDS\n";
  for (const Command& command : line.commands) text += command_text(command);
  text +=
      ".SH CASE FILES\nTOML, SI units. Lists are counted from 0: N stands for the index of an entry, NAME "
      "for a "
      "name\nthat the case gives. Keys of one table:\n" +
      tables_text();
  return text + ".SH EXIT STATUS\n" + tagged("0", "", "done") + tagged("1", "", "the run failed") +
         tagged("2", "", "bad arguments or bad input") + tagged("130", "", "stopped by Ctrl-C or SIGTERM");
}

}  // namespace slagflow
