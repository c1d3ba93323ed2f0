#pragma once

#include <cstddef>
#include <vector>

namespace capstan::base {

/// An empty vector with room for `count` items. Its memory is taken from the system at once. With reserve()
/// alone, a program would grow page by page while items come.
template <class Item>
std::vector<Item> roomFor(std::size_t count) {
  std::vector<Item> items(count);
  items.clear();
  return items;
}

}  // namespace capstan::base
