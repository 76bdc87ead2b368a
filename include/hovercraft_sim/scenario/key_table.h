#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/key_kinds.h"

/// The keys of a map of a scenario are said once, for the parser, the writer and the tests. A table
/// (sensor_keys.h, ...) is a function of an object and a visitor. It calls
///   visit(key, member)
/// for each key, in the order in which they are written. The default of an optional key is what its
/// member has before it is read. What must hold between keys is code of the parser, after them.

namespace hovercraft {

/// The names of the keys in their order. @param object any of its kind: no name depends on its
/// values. @param prefix begins each name.
template <class Table, class Object>
std::vector<std::string> keyNames(const Table& table, const Object& object,
                                  const std::string& prefix = "") {
  std::vector<std::string> names;
  table(object,
        [&](const auto& key, const auto& /*value*/) { names.push_back(prefix + key.name); });
  return names;
}

/// Reads the keys into an object that has the defaults. @throws std::invalid_argument that names
/// key, value and rule.
template <class Table, class Object>
void readKeys(const ConfigReader& reader, const Table& table, Object& object,
              const std::string& prefix = "") {
  table(object, [&](const auto& key, auto& value) {
    const std::string name = prefix + key.name;
    if (key.is_read && (key.is_required || reader.has(name.c_str()))) {
      key.read(reader, name.c_str(), value);
    }
  });
}

/// The same of a map that has no other keys.
template <class Table, class Object>
void parseKeys(const ConfigReader& reader, const Table& table, Object& object) {
  reader.allowOnly(keyNames(table, object));
  readKeys(reader, table, object);
}

/// "name: value" of each key, as in a YAML map on one line, or on lines.
/// @param separator between two of them.
template <class Table, class Object>
std::string keysText(const Table& table, const Object& object, const std::string& prefix = "",
                     const char* separator = ", ") {
  std::string text;
  table(object, [&](const auto& key, const auto& value) {
    if (!key.is_written) return;
    text += (text.empty() ? "" : separator) + prefix + key.name + ": " + key.text(value);
  });
  return text;
}

/// A map of keys within a map.
template <class Table>
struct MapKey : Key {
  MapKey(const char* its_name, const Table& its_table) : Key(its_name, ""), table(&its_table) {}
  template <class Object>
  void read(const ConfigReader& reader, const char* full_name, Object& object) const {
    parseKeys(reader.map(full_name), *table, object);
  }
  template <class Object>
  std::string text(const Object& object) const {
    return "{" + keysText(*table, object) + "}";
  }

  const Table* table;
};

/// Lists of names one after the other.
inline std::vector<std::string> together(std::initializer_list<std::vector<std::string>> lists) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& list : lists)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace hovercraft
