// Owned device memory. Moves, does not copy; copies between host and device are spelled out.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "backend/context.hpp"
#include "backend/span.hpp"

namespace slagflow {

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using Element = T;

  Buffer(Context& context, const char* name, Offset size = 0) : context_(&context), name_(name) {
    resize(size);
  }
  ~Buffer() { context_->release(data_, bytes(capacity_)); }
  Buffer(Buffer&& other) noexcept
      : context_(other.context_),
        name_(other.name_),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }

  void swap(Buffer& other) noexcept {
    std::swap(context_, other.context_);
    std::swap(name_, other.name_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    context_->arrange_anew();
  }

  // Contents are lost when the capacity grows. Where there is any it grows by a quarter at least, so that few
  // of the particles that come one by one take memory; or else with the margin that is given.
  void resize(Offset size) { resize_within(size, capacity_ + capacity_ / 4); }
  void resize(Offset size, Offset margin_percent) { resize_within(size, size + size * margin_percent / 100); }

  // Takes memory for so many elements; contents stay.
  void reserve(Offset capacity) {
    if (capacity <= capacity_) return;
    Buffer roomy(*context_, name_, capacity);
    roomy.resize(size_);
    context_->copy_on_device(roomy.data_, data_, bytes(size_));
    context_->synchronize();
    swap(roomy);
  }

  Offset size() const { return size_; }
  Offset capacity() const { return capacity_; }
  Span<T> span() { return {data_, size_}; }
  Span<const T> span() const { return {data_, size_}; }

  void upload(const std::vector<T>& host) {
    resize(static_cast<Offset>(host.size()));
    context_->copy_to_device(data_, host.data(), bytes(size_));
  }
  void download(std::vector<T>& host) const {
    host.resize(static_cast<std::size_t>(size_));
    context_->copy_to_host(host.data(), data_, bytes(size_));
  }
  void copy_from(const Buffer& other) {
    resize(other.size_);
    context_->copy_on_device(data_, other.data_, bytes(size_));
  }

 private:
  void resize_within(Offset size, Offset room) {
    if (size > capacity_) {
      const Offset wanted = size > room ? size : room;
      context_->synchronize();
      context_->release(data_, bytes(capacity_));
      data_ = nullptr, size_ = capacity_ = 0;
      data_ = static_cast<T*>(context_->allocate(bytes(wanted), name_));
      capacity_ = wanted;
    }
    size_ = size;
  }
  static std::size_t bytes(Offset count) { return static_cast<std::size_t>(count) * sizeof(T); }

  Context* context_;
  const char* name_;
  T* data_ = nullptr;
  Offset size_ = 0, capacity_ = 0;
};

}  // namespace slagflow
