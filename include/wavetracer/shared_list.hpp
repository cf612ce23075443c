// SPDX-License-Identifier: Apache-2.0
// A list whose copies share their memory until one of them is changed. The ends of maps are millions, and all that
// speaks of them has a copy: configurations, worlds, frames.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace wavetracer {

// Used like a std::vector, which it also converts to. A member that may change the list gives it memory of its own
// first, so references into a copy stay as they are. Several threads may read one list, or copies of one; a list that
// is changed belongs to one thread.
template <class T>
class SharedList {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;

  SharedList() = default;
  SharedList(std::vector<T> values) : values_(std::make_shared<std::vector<T>>(std::move(values))) {}
  SharedList(std::initializer_list<T> values) : SharedList(std::vector<T>(values)) {}
  SharedList& operator=(std::vector<T> values) { return *this = SharedList(std::move(values)); }
  SharedList& operator=(std::initializer_list<T> values) { return *this = SharedList(values); }

  const std::vector<T>& values() const { return values_ ? *values_ : none(); }
  operator const std::vector<T>&() const { return values(); }
  // Gives this list memory of its own, which may be changed.
  std::vector<T>& edit() {
    if (!values_ || values_.use_count() > 1) values_ = std::make_shared<std::vector<T>>(values());
    return *values_;
  }

  // Are both the same memory, so that their values are equal?
  bool shares(const SharedList& other) const { return values_ == other.values_; }

  size_t size() const { return values().size(); }
  bool empty() const { return values().empty(); }
  const T* data() const { return values().data(); }
  const T& operator[](size_t i) const { return values()[i]; }
  const T& at(size_t i) const { return values().at(i); }
  const T& front() const { return values().front(); }
  const T& back() const { return values().back(); }
  const_iterator begin() const { return values().begin(); }
  const_iterator end() const { return values().end(); }

  T* data() { return edit().data(); }
  T& operator[](size_t i) { return edit()[i]; }
  T& at(size_t i) { return edit().at(i); }
  T& front() { return edit().front(); }
  T& back() { return edit().back(); }
  iterator begin() { return edit().begin(); }
  iterator end() { return edit().end(); }
  void push_back(T value) { edit().push_back(std::move(value)); }
  template <class... Parts>
  T& emplace_back(Parts&&... parts) {
    return edit().emplace_back(std::forward<Parts>(parts)...);
  }
  void pop_back() { edit().pop_back(); }
  void resize(size_t size) { edit().resize(size); }
  void reserve(size_t size) { edit().reserve(size); }
  void clear() { values_.reset(); }
  template <class... Parts>
  iterator insert(Parts&&... parts) {
    return edit().insert(std::forward<Parts>(parts)...);
  }
  template <class... Parts>
  iterator erase(Parts&&... parts) {
    return edit().erase(std::forward<Parts>(parts)...);
  }

  friend bool operator==(const SharedList& a, const SharedList& b) { return a.shares(b) || a.values() == b.values(); }

 private:
  static const std::vector<T>& none() {
    static const std::vector<T> empty;
    return empty;
  }

  std::shared_ptr<std::vector<T>> values_;
};

}  // namespace wavetracer
