#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// A value of a scenario, a snapshot or a set of parameters, as it was written: nothing, a text, a
/// list, or a map. It never changes and its copies share what it holds, so that a copy costs
/// nothing and an alias of YAML is one.
class HOVERCRAFT_PUBLIC ConfigNode {
 public:
  enum class Kind { kNull, kText, kList, kMap };
  using List = std::vector<ConfigNode>;                         // in the order of the text
  using Map = std::vector<std::pair<std::string, ConfigNode>>;  // in the order of the text

  ConfigNode() = default;  // nothing
  /// @param is_plain not in quotes: it may be a number or true or false.
  static ConfigNode ofText(std::string text, bool is_plain);
  /// @param items in their order.
  static ConfigNode ofList(List items);
  /// @param members each key once.
  static ConfigNode ofMap(Map members);

  /// What it is.
  Kind kind() const { return content_ ? content_->kind : Kind::kNull; }
  bool isNull() const { return kind() == Kind::kNull; }
  bool isMap() const { return kind() == Kind::kMap; }
  bool isList() const { return kind() == Kind::kList; }
  bool isText() const { return kind() == Kind::kText; }
  /// A text that was not in quotes.
  bool isPlainText() const { return isText() && content_->is_plain; }

  /// Empty if it is no text, no list, no map.
  const std::string& text() const { return content().text; }
  const List& items() const { return content().items; }
  const Map& members() const { return content().members; }
  /// What a map holds behind a key; null pointer if it does not, or this is no map.
  const ConfigNode* find(const std::string& key) const;

  /// How many values there are if every alias is written out; of a long text one for each
  /// kTextPerValue bytes. The largest number if there are more than fit.
  std::size_t size() const { return content_ ? content_->size : 1; }
  /// How many lists and maps lie within each other: 0 for a text.
  std::size_t depth() const { return content_ ? content_->depth : 0; }
  static constexpr std::size_t kTextPerValue = 64;  // bytes

  /// The beginning of the value as YAML on one line, without quotes.
  /// @param least how many bytes of it are wanted; there may be more.
  std::string beginning(std::size_t least) const;

 private:
  struct Content {
    Kind kind = Kind::kNull;
    bool is_plain = false;
    std::string text;
    List items;
    Map members;
    std::vector<std::size_t> by_key;  // indices of members
    std::size_t size = 1;
    std::size_t depth = 0;
  };

  static ConfigNode of(Content content);
  const Content& content() const;
  void append(std::string& text, std::size_t least) const;

  std::shared_ptr<const Content> content_;
};

}  // namespace hovercraft
