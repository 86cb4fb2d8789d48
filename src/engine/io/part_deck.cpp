// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/part_deck.h"

#include <algorithm>
#include <unordered_map>

#include "error.h"

namespace femscalpel {
namespace {

/// See take_parts_apart().
class PartSplitter {
public:
    explicit PartSplitter(const std::vector<Card>& cards) {
        for (const Card& card : cards) take(card);
        for (const Card* open : {part_, instance_, assembly_})
            if (open)
                throw ReadError(open->where() + ": *" + open->keyword + " has no *END " + open->keyword +
                                "; add it behind the last card that belongs to it");
        finish();
    }

    PartDeck run() { return std::move(out_); }

private:
    struct Part {
        std::string name;
        const Card* card = nullptr;
        std::vector<const Card*> cards;
        bool used = false;
    };

    void take(const Card& card) {
        if (card.keyword == "PART") {
            open(part_, card);
            const auto [it, is_new] = index_.emplace(name_key(name_of(card)), parts_.size());
            if (!is_new)
                throw ReadError(card.where() + ": a part '" + name_of(card) + "' is there already (" +
                                parts_[it->second].card->where() + "); give one another name");
            parts_.push_back({name_of(card), &card, {}});
            bracket(card);
        } else if (card.keyword == "INSTANCE") {
            open(instance_, card);
            start_instance(card);
        } else if (card.keyword == "ASSEMBLY") {
            open(assembly_, card);
            if (const std::string* name = card.parameter("NAME")) out_.assembly = unquoted(*name);
            bracket(card);
        } else if (card.keyword == "ENDPART") {
            close(part_, card, "PART");
        } else if (card.keyword == "ENDINSTANCE") {
            close(instance_, card, "INSTANCE");
        } else if (card.keyword == "ENDASSEMBLY") {
            close(assembly_, card, "ASSEMBLY");
        } else if (part_) {
            parts_.back().cards.push_back(&card);
        } else if (instance_) {
            out_.instances.back().cards.push_back(&card);
        } else {
            out_.items.push_back({&card});
        }
    }

    void bracket(const Card& card) { out_.items.push_back({&card, true}); }

    static std::string name_of(const Card& card) {
        const std::string* name = card.parameter("NAME");
        if (!name || name_key(*name).empty()) throw ReadError(card.where() + ": *" + card.keyword + " needs NAME=");
        return unquoted(*name);
    }

    void open(const Card*& which, const Card& card) const {
        const bool in_assembly = assembly_ && card.keyword != "INSTANCE";
        for (const Card* other : {part_, instance_, in_assembly ? assembly_ : nullptr})
            if (other)
                throw ReadError(card.where() + ": *" + card.keyword + " stands before the *END " + other->keyword +
                                " of " + other->where());
        which = &card;
    }

    void close(const Card*& which, const Card& card, const std::string& keyword) {
        if (!which) throw ReadError(card.where() + ": *END " + keyword + " without *" + keyword + " before it");
        if (&which == &assembly_ && (part_ || instance_))
            throw ReadError(card.where() + ": *END ASSEMBLY stands before the *END " +
                            (part_ ? part_ : instance_)->keyword + " of " + (part_ ? part_ : instance_)->where());
        which = nullptr;
        bracket(card);
    }

    void start_instance(const Card& card) {
        if (card.parameter("LIBRARY") || card.parameter("INSTANCE"))
            throw ReadError(card.where() +
                            ": an instance imported from the results of another analysis has no mesh here; write a "
                            "deck that has it as a part");
        PartInstance instance;
        instance.name = name_of(card);
        if (deck_number(instance.name))
            throw ReadError(card.where() + ": the instance's name, '" + instance.name + "', is a number, so that '" +
                            instance.name + ".1' could be one, too; give it a name that starts with a letter");
        const auto [it, is_new] = instances_.emplace(name_key(instance.name), &card);
        if (!is_new)
            throw ReadError(card.where() + ": an instance '" + instance.name + "' is there already (" +
                            it->second->where() + "); give one another name");
        const std::string* part = card.parameter("PART");
        if (!part || name_key(*part).empty()) throw ReadError(card.where() + ": *INSTANCE needs PART=name of a part");
        instance.part = unquoted(*part);
        instance.card = &card;
        instance.placement = placement_of_instance(card);
        out_.items.push_back({nullptr, false, out_.instances.size()});
        out_.instances.push_back(std::move(instance));
    }

    /// Parts may stand behind the assembly.
    void finish() {
        for (PartInstance& instance : out_.instances) {
            const auto it = index_.find(name_key(instance.part));
            if (it == index_.end())
                throw ReadError(instance.card->where() + ": instance '" + instance.name + "' is of part '" +
                                instance.part + "', which the deck does not have");
            Part& part = parts_[it->second];
            instance.first = !part.used;
            part.used = true;
            instance.cards.insert(instance.cards.begin(), part.cards.begin(), part.cards.end());
        }
        for (const Part& part : parts_)
            if (!part.used)
                out_.warnings.push_back(part.card->where() + ": part '" + part.name +
                                        "' has no instance, so nothing of it is in the model; left out");
    }

    PartDeck out_;
    std::vector<Part> parts_;
    std::unordered_map<std::string, std::size_t> index_;                      // of parts by name
    std::unordered_map<std::string, const Card*> instances_;                  // by name
    const Card *part_ = nullptr, *instance_ = nullptr, *assembly_ = nullptr;  // that are open
};

}  // namespace

std::string unquoted(std::string_view name) {
    std::string out;
    for (const char c : name)
        if (c != '"') out += c;
    const std::size_t first = out.find_first_not_of(" \t\r\n");
    if (first == out.npos) return "";
    return out.substr(first, out.find_last_not_of(" \t\r\n") - first + 1);
}

std::string name_key(std::string_view name) {
    std::string out = deck_key(name);
    std::erase_if(out, [](char c) { return c == '"' || c == '\n'; });
    return out;
}

PartDeck take_parts_apart(const std::vector<Card>& cards) { return PartSplitter(cards).run(); }

}  // namespace femscalpel
