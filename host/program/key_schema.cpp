// A JSON schema of case files, for editors.
#include "host/case/case_catalogue.hpp"
#include "host/output/summary_json.hpp"
#include "host/program/key_help.hpp"

namespace slagflow {
namespace {

Json list_of(const Words& words) {
  Json::Array array;
  for (const std::string& word : words) array.emplace_back(word);
  return array;
}

Json typed(const char* type) { return Json::object().set("type", type); }

Json number_schema(const Range& range, const char* type) {
  Json schema = typed(type);
  if (range.lower > -Range::largest)
    schema.set(range.lower_bound == Bound::open ? "exclusiveMinimum" : "minimum", range.lower);
  if (range.upper < Range::largest)
    schema.set(range.upper_bound == Bound::open ? "exclusiveMaximum" : "maximum", range.upper);
  return schema;
}

Json array_schema(Json items) { return typed("array").set("items", std::move(items)); }

Json array_schema(Json items, int entries) {
  return array_schema(std::move(items)).set("minItems", entries).set("maxItems", entries);
}

Json either(Json a, Json b) { return Json::object().set("anyOf", Json::Array{std::move(a), std::move(b)}); }

Json word_schema(const Words& words) { return Json::object().set("enum", list_of(words)); }

Json table_schema(const std::string& table);

Json number_or_word(const CatalogueKey& k) {
  const Json number = number_schema(k.range, "number");
  return k.word.empty() ? number : either(number, word_schema({k.word}));
}

Json value_schema(const CatalogueKey& k) {
  const Json number = typed("number");
  switch (k.form) {
    case Form::number:
      return number_or_word(k);
    case Form::integer:
      return number_schema(k.range, "integer");
    case Form::vector:
      return array_schema(number, 3);
    case Form::flag:
      return typed("boolean");
    case Form::numbers:
      return array_schema(number);
    case Form::pairs:
      return array_schema(array_schema(number, 2));
    case Form::vectors:
      return array_schema(array_schema(number, 3));
    case Form::number_or_rows:
      return either(number_schema(k.range, "number"), array_schema(array_schema(number, 2)));
    case Form::choice:
      return word_schema(k.words);
    case Form::choices:
      return array_schema(word_schema(k.words));
    case Form::choice_or_number:
      return either(word_schema(k.words), number_schema(k.range, "number"));
    case Form::table:
      return table_schema(k.inside);
    case Form::list:
      return array_schema(table_schema(k.inside));
    case Form::named_list:
      return typed("object").set("additionalProperties", table_schema(k.inside));
    default:
      return typed("string");
  }
}

std::string description_of(const CatalogueKey& k) {
  std::string text = k.where.empty() ? "" : "With " + k.where_text() + ": ";
  text += k.meaning;
  if (!k.unit.empty()) text += " [" + k.unit + "]";
  if (!k.allowed.empty()) text += "; " + k.allowed;
  if (!k.fallback.empty()) text += "; default " + k.fallback;
  return text;
}

Json table_schema(const std::string& table) {
  Json properties = Json::object();
  Json::Array needed;
  for (const CatalogueKey* k : catalogue().in(table)) {
    Json schema = value_schema(*k).set("description", description_of(*k));
    const Json& other = properties.at(k->name);
    if (!other.is_null()) schema = either(other, schema);  // of another kind of entry
    properties.set(k->name, schema);
    if (k->need == Need::required && k->where.empty()) needed.emplace_back(k->name);
  }
  Json schema = typed("object").set("additionalProperties", false).set("properties", properties);
  return needed.empty() ? schema : schema.set("required", needed);
}

}  // namespace

std::string key_schema() {
  Json schema = Json::object();
  schema.set("$schema", "http://json-schema.org/draft-07/schema#").set("title", "a case of slagflow");
  const Json keys = table_schema("");
  for (const auto& [name, value] : keys.entries()) schema.set(name, value);
  return schema.text() + "\n";
}

}  // namespace slagflow
