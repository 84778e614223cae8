#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace limn {

/// Rows of a table that is made from above and forgotten from above.
template <class T> class SlidingRows {
public:
    explicit SlidingRows(std::size_t width) : width_(width) {}

    std::size_t width() const { return width_; }
    int end() const { return first_ + int(rows_.size()); } ///< after the last row there is
    std::vector<T>& row(int r) { return rows_[std::size_t(r - first_)]; }
    const std::vector<T>& row(int r) const { return rows_[std::size_t(r - first_)]; }
    void extend(int end, const T& value)
    {
        while (this->end() < end)
            rows_.emplace_back(width_, value);
    }
    void append(std::vector<T> row) { rows_.push_back(std::move(row)); }
    void drop_before(int r)
    {
        for (; first_ < r && !rows_.empty(); ++first_)
            rows_.pop_front();
    }

private:
    std::size_t width_;
    int first_ = 0;
    std::deque<std::vector<T>> rows_;
};

} // namespace limn
