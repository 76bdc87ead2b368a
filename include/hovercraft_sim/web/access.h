#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Who may look and drive.
struct AccessRules {
  std::vector<std::string> hosts;  // names besides localhost and addresses, in lower case
  std::string token;               // empty: none is asked for
};

/// What of the head of an HTTP request decides about it.
struct RequestHead {
  std::string method;
  std::string target;
  std::vector<std::string> hosts;    // each Host field
  std::vector<std::string> origins;  // each Origin field
  bool is_upgrade = false;           // to a WebSocket
};

/// What a request is answered by.
enum class [[nodiscard]] Verdict{kPage,        kScript,     kSocket,      kBadRequest, kWrongHost,
                                 kWrongOrigin, kWrongToken, kWrongMethod, kNotFound};

/// The pages are two names of this list and no others: no path leads to a file.
///
/// Host must be `localhost`, an address, or a name of the rules. (A page of another site whose name
/// was made to lead here, by DNS rebinding, has that site's name in it.) Where a browser gives an
/// Origin it must be this server as Host names it. A WebSocket needs the token, if there is one, as
/// `/socket?token=TOKEN`.
HOVERCRAFT_PUBLIC Verdict verdictOn(const RequestHead& request, const AccessRules& rules);

/// "NAME", "1.2.3.4" or "[::1]" of a Host field, in lower case, without its port; nothing if it is
/// no such field.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<std::string> hostWithoutPort(std::string_view field);

/// In a time that does not tell where they differ. @param said what somebody says the token is.
HOVERCRAFT_PUBLIC bool isToken(std::string_view said, std::string_view token);

/// Whether it may be a token: 16 to 128 letters, digits, - and _.
HOVERCRAFT_PUBLIC bool isGoodToken(std::string_view token);

}  // namespace hovercraft_ros
