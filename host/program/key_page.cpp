// The reference of keys as Markdown.
#include "host/case/case_catalogue.hpp"
#include "host/program/key_help.hpp"

namespace slagflow {
namespace {

// In a cell of a table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string default_cell(const CatalogueKey& k) {
  if (k.need == Need::required) return "required";
  if (k.fallback.empty() || k.in_words || k.fallback == "none") return cell(k.fallback);
  return k.fallback == "\"\"" ? "empty" : "`" + cell(k.fallback) + "`";
}

std::string meaning_cell(const CatalogueKey& k) {
  std::string text = k.where.empty() ? "" : "with " + k.where_text() + ": ";
  text += k.meaning;
  if (k.is_table() && k.inside == "shape") text += "; keys under `shape`";
  return cell(text);
}

std::string type_cell(const CatalogueKey& k) {
  std::string text = k.type_text();
  if (!k.unit.empty()) text += " [" + k.unit + "]";
  if (!k.allowed.empty()) text += "; " + k.allowed;
  return cell(text);
}

std::string heading(const CatalogueKey& table) {
  if (table.inside == "shape") return "### `shape`\n\nThe entries of `shapes` and `subtract`.\n";
  const bool top = table.table.empty();
  const std::string name = table.form == Form::list
                               ? (top ? "[[" + table.name + "]]" : table.path() + " = [{...}, ...]")
                           : top || table.form == Form::named_list ? "[" + table.inside + "]"
                                                                   : table.path() + " = {...}";
  return "### `" + name + "`\n\n" + cell(table.meaning) + "\n";
}

std::string section(const CatalogueKey& table) {
  std::string text =
      heading(table) + "\n| key | type, unit, what is allowed | default | meaning |\n|---|---|---|---|\n";
  for (const CatalogueKey* k : catalogue().in(table.inside))
    text += "| `" + k->name + "` | " + type_cell(*k) + " | " + default_cell(*k) + " | " + meaning_cell(*k) +
            " |\n";
  return text + "\n";
}

}  // namespace

std::string key_page() {
  std::string text;
  std::vector<std::string> done;
  for (const CatalogueKey& k : catalogue().keys()) {
    if (!k.is_table()) continue;
    bool again = false;
    for (const std::string& inside : done) again = again || inside == k.inside;
    if (!again) text += section(k);
    done.push_back(k.inside);
  }
  text.pop_back();
  return text;
}

}  // namespace slagflow
