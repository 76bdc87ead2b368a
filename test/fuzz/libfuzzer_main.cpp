#include <cstddef>
#include <cstdint>
#include <string>

#include "targets.h"

/// The entry that libFuzzer calls; which target it is says the build.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hovercraft::fuzz::HOVERCRAFT_FUZZ_TARGET(std::string(data, data + size));
  return 0;
}
