#include <utility>

#include "host/case/case_catalogue.hpp"
#include "host/program/command_line.hpp"
#include "host/program/init.hpp"
#include "host/rheometry/rheometry_options.hpp"

namespace slagflow {
namespace {

std::string spaced(const std::string& names) {
  std::string text = names;
  for (char& c : text)
    if (c == ',') c = ' ';
  return text;
}

std::string options_of(const Command& command) {
  std::string text;
  for (const CommandOption& option : command.options)
    if (!option.positional) text += (text.empty() ? "" : " ") + spaced(option.names);
  return text;
}

// As --set addresses a key: the first entry of a list. Empty: it depends on names of the case.
std::string set_path(const CatalogueKey& k) {
  if (k.is_table() || k.table == "shape" || k.path().find("NAME") != std::string::npos) return "";
  std::string path = k.path();
  for (auto at = path.find(".N."); at != std::string::npos; at = path.find(".N.")) path.replace(at, 3, ".0.");
  return path;
}

// "  word) COMPREPLY=(...) ;;"
std::string branch(const std::string& pattern, const std::string& words) {
  return "    " + pattern + ") COMPREPLY=($(compgen -W '" + words + "' -- \"$cur\")) ;;\n";
}

std::string commands_of(const CommandLine& line) {
  std::string text = "--help --version";
  for (const Command& command : line.commands) text += " " + command.name;
  return text;
}

std::string keys_to_set() {
  std::string text;
  for (const CatalogueKey& k : catalogue().keys())
    if (const std::string path = set_path(k); !path.empty()) text += (text.empty() ? "" : " ") + path + "=";
  return text;
}

std::string topics() {
  std::string text;
  for (const CatalogueKey& k : catalogue().keys()) text += (text.empty() ? "" : " ") + k.path();
  return text;
}

std::string templates() {
  std::string text;
  for (const CaseTemplate& one : case_templates()) text += (text.empty() ? "" : " ") + std::string(one.name);
  return text;
}

std::string models() {
  std::string text;
  for (const std::string& name : model_names()) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string values() {
  std::string text;
  for (const CatalogueKey& k : catalogue().keys()) {
    Words words = k.words;
    if (!k.word.empty()) words.push_back(k.word);
    if (k.form == Form::flag) words = {"true", "false"};
    const std::string path = set_path(k);
    if (path.empty() || words.empty() || k.form == Form::choices) continue;
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : " ") + word;
    text += branch(path, list);
  }
  return text;
}

// With @WORDS@ in the places of what the declarations say.
const char* const script = R"(# Completion of slagflow for bash, as `slagflow help --completion` prints it.
_slagflow_values() {
  case $1 in
@VALUES@  esac
}
_slagflow_options() {
  case $1 in
@OPTIONS@  esac
}
_slagflow() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '@COMMANDS@' -- "$cur"))
    return
  fi
  # bash takes KEY, = and VALUE of --set KEY=VALUE for three words.
  if [ "$cur" = = ]; then
    cur=
    _slagflow_values "$prev"
    return
  fi
  if [ "$prev" = = ]; then
    _slagflow_values "${COMP_WORDS[COMP_CWORD-2]}"
    return
  fi
  case $prev in
    --set)
      COMPREPLY=($(compgen -W '@KEYS@' -- "$cur"))
      compopt -o nospace
      return
      ;;
    -o | --output)
      COMPREPLY=($(compgen -f -- "$cur"))
      return
      ;;
    --template)
      COMPREPLY=($(compgen -W '@TEMPLATES@' -- "$cur"))
      return
      ;;
    --model)
      COMPREPLY=($(compgen -W '@MODELS@' -- "$cur"))
      return
      ;;
    --from)
      COMPREPLY=($(compgen -d -- "$cur"))
      return
      ;;
  esac
  case $command,$cur in
    *,-*) _slagflow_options "$command" ;;
    help,*) COMPREPLY=($(compgen -W '@TOPICS@' -- "$cur")) ;;
    init,*) COMPREPLY=($(compgen -W '@TEMPLATES@' -- "$cur")) ;;
    resume,*) COMPREPLY=($(compgen -d -- "$cur")) ;;
    run,* | check,*) COMPREPLY=($(compgen -f -X '!*.toml' -- "$cur") $(compgen -d -S / -- "$cur")) ;;
    *) COMPREPLY=($(compgen -f -- "$cur")) ;;
  esac
}
complete -F _slagflow slagflow
)";

}  // namespace

std::string bash_completion(const CommandLine& line) {
  std::string options, text = script;
  for (const Command& command : line.commands) options += branch(command.name, options_of(command));
  for (const auto& [mark, words] : {std::pair{"@VALUES@", values()}, std::pair{"@OPTIONS@", options},
                                    std::pair{"@COMMANDS@", commands_of(line)},
                                    std::pair{"@KEYS@", keys_to_set()}, std::pair{"@TOPICS@", topics()},
                                    std::pair{"@TEMPLATES@", templates()}, std::pair{"@MODELS@", models()}})
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark))
      text.replace(at, std::string(mark).size(), words);
  return text;
}

}  // namespace slagflow
