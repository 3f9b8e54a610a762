#include "host/program/key_help.hpp"

#include <algorithm>
#include <vector>

#include "backend/error.hpp"
#include "host/case/case_catalogue.hpp"

namespace slagflow {
namespace {

using Keys = std::vector<const CatalogueKey*>;

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

// Whether a topic is this path of the catalogue. What stands for an entry, N or NAME, may be any word or left
// out.
bool is_topic(const std::vector<std::string>& topic, const std::vector<std::string>& path, std::size_t t = 0,
              std::size_t p = 0) {
  if (p == path.size()) return t == topic.size();
  const bool entry = path[p] == "N" || path[p] == "NAME";
  if (entry && is_topic(topic, path, t, p + 1)) return true;
  return t < topic.size() && (entry || topic[t] == path[p]) && is_topic(topic, path, t + 1, p + 1);
}

// How wide a text stands in a terminal: its characters, of UTF-8.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Words in lines of up to 100 characters that begin with an indent.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t widest = 100;
  std::string out, line;
  const auto flush = [&] { out += std::string(indent, ' ') + line + "\n", line.clear(); };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && indent + width_of(line) + 1 + width_of(word) > widest) flush();
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  if (!line.empty()) flush();
  return out;
}

std::string default_text(const CatalogueKey& k) {
  if (k.need == Need::required) return "required";
  return k.fallback.empty() ? "" : "default " + k.fallback;
}

std::string facts_of(const CatalogueKey& k) {
  std::string text = k.type_text() + (k.unit.empty() ? "" : " [" + k.unit + "]");
  for (const std::string& more : {k.allowed, default_text(k)})
    if (!more.empty()) text += "; " + more;
  return text;
}

std::string in_full(const CatalogueKey& k) {
  std::string text = k.path() + "\n" + wrapped(facts_of(k), 4);
  if (!k.where.empty()) text += wrapped("with " + k.where_text(), 4);
  return text + wrapped(k.meaning, 4);
}

std::string table_text(const CatalogueKey& table) {
  const std::string brackets = table.table.empty() && table.form == Form::list ? "[[" + table.name + "]]"
                               : table.form == Form::list ? table.path() + " = [{...}, ...]"
                                                          : "[" + table.inside + "]";
  std::string text = brackets + "  " + table.meaning + "\n\n";
  for (const CatalogueKey* k : catalogue().in(table.inside)) text += in_full(*k) + "\n";
  return text;
}

std::string all_tables() {
  std::string text = "The tables of a case file:\n\n";
  for (const CatalogueKey* k : catalogue().in("")) {
    const std::string name = k->form == Form::list ? "[[" + k->name + "]]" : "[" + k->inside + "]";
    text += "  " + name + std::string(name.size() < 16 ? 16 - name.size() : 1, ' ') + k->meaning + "\n";
  }
  return text +
         "\nslagflow help TABLE tells of the keys of a table, slagflow help KEY of a key, such as\n"
         "slagflow help numerics, slagflow help yield_stress or slagflow help fluid.slag.density.\n"
         "Commands: slagflow --help.\n";
}

// Keys whose path the topic is; if there is none, tables by an entry, as wall.0; if there is none, keys of
// that name.
Keys matches(const std::string& topic) {
  const std::vector<std::string> parts = parts_of(topic);
  Keys found;
  const auto take = [&](const auto& is_meant) {
    if (!found.empty()) return;
    for (const CatalogueKey& k : catalogue().keys())
      if (is_meant(k)) found.push_back(&k);
  };
  take([&](const CatalogueKey& k) { return is_topic(parts, parts_of(k.path())); });
  take([&](const CatalogueKey& k) { return k.is_table() && is_topic(parts, parts_of(k.inside)); });
  take([&](const CatalogueKey& k) { return k.name == topic; });
  return found;
}

[[noreturn]] void refuse(const std::string& topic) {
  std::vector<std::string> known, tables;
  for (const CatalogueKey& k : catalogue().keys()) known.push_back(k.name), known.push_back(k.path());
  for (const CatalogueKey* k : catalogue().in("")) tables.push_back(k->name);
  throw InputError("help " + topic + ": is no key and no table: " + suggestion(topic, known) +
                   "allowed: a key, or one of " + join(tables));
}

}  // namespace

std::string key_help(const std::string& topic) {
  if (topic.empty()) return all_tables();
  const Keys found = matches(topic);
  if (found.empty()) refuse(topic);
  std::string text;
  std::vector<std::string> shown;  // tables; lists of shapes share one
  for (const CatalogueKey* k : found) {
    if (!k->is_table()) {
      text += in_full(*k) + "\n";
    } else if (std::find(shown.begin(), shown.end(), k->inside) == shown.end()) {
      text += table_text(*k);
      shown.push_back(k->inside);
    }
  }
  text.pop_back();
  return text;
}

}  // namespace slagflow
