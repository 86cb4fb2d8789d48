// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cancel.h"

namespace femscalpel {
namespace {

/// The innermost scope of each thread.
constinit thread_local CancelScope* innermost = nullptr;

}  // namespace

CancelScope::CancelScope(CancelToken token, std::function<bool()> question)
    : tokens_{std::move(token)}, question_(std::move(question)), outer_(innermost) {
    innermost = this;
}

CancelScope::CancelScope(std::vector<CancelToken> tokens) : tokens_(std::move(tokens)), outer_(innermost) {
    innermost = this;
}

CancelScope::~CancelScope() { innermost = outer_; }

std::vector<CancelToken> CancelScope::current() {
    std::vector<CancelToken> out;
    for (const CancelScope* s = innermost; s; s = s->outer_)
        out.insert(out.end(), s->tokens_.begin(), s->tokens_.end());
    return out;
}

void check_cancelled() {
    for (const CancelScope* s = innermost; s; s = s->outer_) {
        if (s->question_ && s->question_()) s->tokens_.front().cancel();
        for (const CancelToken& token : s->tokens_)
            if (token.cancelled()) throw Cancelled();
    }
}

}  // namespace femscalpel
