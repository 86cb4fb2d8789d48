// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <utility>
#include <vector>

#include "error.h"

namespace femscalpel {

/// What was asked to end early has ended: nothing was changed, nothing was written.
class Cancelled : public Error {
public:
    Cancelled() : Error("cancelled") {}
};

/// Ends computations from another thread: those that run in a CancelScope of it. Copies are the same token.
class CancelToken {
public:
    void cancel() const noexcept { cancelled_->store(true, std::memory_order_relaxed); }
    bool cancelled() const noexcept { return cancelled_->load(std::memory_order_relaxed); }

private:
    std::shared_ptr<std::atomic<bool>> cancelled_ = std::make_shared<std::atomic<bool>>(false);
};

/// While it lives, what this thread computes ends with Cancelled soon after its token is cancelled: every function of
/// the engine looks at check points that are some milliseconds apart, at most a tenth of a second in meshes of millions
/// of elements. Scopes nest; all of them count. A scope belongs to the thread that made it; threads that the engine
/// starts are in it, too.
class CancelScope {
public:
    /// `question`, if any, is asked at every check point of this thread, and true cancels the token. It must not throw.
    explicit CancelScope(CancelToken token, std::function<bool()> question = {});
    /// For a thread that works for another: what that one obeys.
    explicit CancelScope(std::vector<CancelToken> tokens);
    ~CancelScope();
    CancelScope(const CancelScope&) = delete;
    CancelScope& operator=(const CancelScope&) = delete;

    /// What the current thread obeys.
    static std::vector<CancelToken> current();

private:
    friend void check_cancelled();
    std::vector<CancelToken> tokens_;
    std::function<bool()> question_;
    CancelScope* outer_;
};

/// A check point: throws Cancelled when the current thread is to end. Costs a few nanoseconds, outside of a scope less.
/// Not in code that has begun to change what belongs to the caller.
void check_cancelled();

/// A check point for loops of short steps: looks once in so many calls.
class SparseCheck {
public:
    explicit SparseCheck(int stride = 1024) : stride_(stride), left_(stride) {}
    void operator()() {
        if (--left_ > 0) return;
        left_ = stride_;
        check_cancelled();
    }

private:
    int stride_, left_;
};

/// std::async() for a function that obeys what the calling thread does.
template <class Function>
auto async_obeying(std::launch policy, Function function) {
    return std::async(policy, [function = std::move(function), tokens = CancelScope::current()]() mutable {
        const CancelScope scope(std::move(tokens));
        return function();
    });
}

/// What `future` gives; check points while it is not there yet.
template <class T>
T await(std::future<T>& future) {
    while (future.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout) check_cancelled();
    return future.get();
}

}  // namespace femscalpel
