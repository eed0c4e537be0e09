// SPDX-License-Identifier: Apache-2.0
#include "limpet/recording.hpp"

#include "limpet/core/find_by.hpp"
#include "limpet/face/inside.hpp"

namespace limpet {

struct Recording::Inside {
    InnerRecording recording;
    std::vector<PastEvent> events;
};

Recording::Recording(const std::filesystem::path& file) {
    Inside inside{.recording = record::read_recording(file), .events = {}};
    for (const record::RecordedEvent& event : inside.recording.events) {
        inside.events.push_back(
            {event.time_s, event.station, event.name, event.reason, event.values});
    }
    inside_ = std::make_shared<const Inside>(std::move(inside));
}

std::vector<std::string> Recording::topics() const {
    return names_of(inside_->recording.tables, &record::Table::topic);
}

std::vector<std::string> Recording::columns(std::string_view topic) const {
    return names_of(inside_->recording.table(topic).columns);
}

Series Recording::series(std::string_view topic, std::string_view column) const {
    const auto found = inside_->recording.series(topic, column);
    return {.time_s = found.time_s, .values = found.values};
}

const std::vector<PastEvent>& Recording::events() const {
    return inside_->events;
}

std::string Recording::scenario_yaml() const {
    const auto* text = inside_->recording.attachment("scenario.yaml");
    return text == nullptr ? std::string() : text->text;
}

const std::string& Recording::damage() const {
    return inside_->recording.damage;
}

}  // namespace limpet
