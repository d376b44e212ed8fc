// What the standard library takes several calls for.
#pragma once

#include <algorithm>

namespace frond {

template <class List, class Is>
void remove_where(List& list, const Is& is) {
    list.erase(std::remove_if(list.begin(), list.end(), is), list.end());
}
template <class List>
void sort_unique(List& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace frond
