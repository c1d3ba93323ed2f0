#include "core/live/cameras/http_url.h"
#include "tests/fuzz/fuzz_target.h"

/// Address of a network camera.
CAPSTAN_FUZZ_TARGET(http_url) {
  using namespace capstan;
  const std::string address = "http://" + std::string(bytes);
  fuzz::require(live::isHttpAddress(address), "an address of HTTP");
  fuzz::allowInputError([&] {
    const live::HttpUrl url = live::parseHttpUrl(address);
    fuzz::require(!url.host.empty(), "a host");
    fuzz::require(url.port > 0 && url.port < 65536, "a port");
    fuzz::require(url.path.starts_with('/'), "a path");
    const live::HttpUrl open = live::parseHttpUrl(live::withoutPassword(address));
    fuzz::require(open.user.empty() && open.password.empty(), "no password is left");
    fuzz::require(open.host == url.host && open.port == url.port && open.path == url.path, "the same camera");
  });
}
