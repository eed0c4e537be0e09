// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/errors.hpp"
#include "limpet/rare/rare.hpp"
#include "limpet/study/study.hpp"

namespace limpet::study {

std::optional<StudyRequest> study_request(campaign::Results& results) {
    return campaign::asking(results.database(), [&]() -> std::optional<StudyRequest> {
        if (!results.database().tableExists("study")) {
            return std::nullopt;
        }
        SQLite::Statement select(results.database(), "SELECT * FROM study");
        if (!select.executeStep() || select.getColumnCount() != 2) {
            campaign::refuse(results.database(), "is damaged: it does not say what was studied");
        }
        StudyRequest request{.figure = select.getColumn(0).getString(),
                             .samples = select.getColumn(1).getUInt()};
        if (request.samples < 2) {
            campaign::refuse(results.database(), "is damaged: a study of fewer than two samples");
        }
        return request;
    });
}

void begin_study(campaign::Results& results, const StudyRequest& request) {
    rare::require_plain(results);
    const std::optional<StudyRequest> there = study_request(results);
    if (there && there->samples != request.samples) {
        campaign::refuse(results.database(),
                         "was begun with --samples {}; finish it so, or give another --out",
                         there->samples);
    }
    if (!there && results.finished() > 0) {
        campaign::refuse(results.database(), "holds a campaign, not a study; give another --out");
    }
    campaign::asking(results.database(), [&] {
        SQLite::Transaction transaction(results.database());
        results.database().exec(
            "CREATE TABLE IF NOT EXISTS study (figure TEXT, samples INTEGER);"
            "DELETE FROM study");
        SQLite::Statement insert(results.database(), "INSERT INTO study VALUES (?, ?)");
        SQLite::bind(insert, request.figure, static_cast<std::int64_t>(request.samples));
        insert.exec();
        transaction.commit();
    });
}

void require_no_study(campaign::Results& results) {
    if (const auto request = study_request(results)) {
        campaign::refuse(results.database(), "holds a study of {}; go on with it by limpet study",
                         request->figure);
    }
}

std::optional<NoiseBlend> study_noise(campaign::Results& results, std::uint32_t run) {
    const std::optional<StudyRequest> request = study_request(results);
    if (!request) {
        return std::nullopt;
    }
    return point_of(plan_of(results.campaign(), request->samples), run).noise;
}

campaign::Progress fly_study(campaign::Results& results, int jobs,
                             const campaign::CampaignWatch& watch) {
    const campaign::Campaign& campaign = results.campaign();
    const StudyRequest request = required(study_request(results), "a study that was begun");
    const StudyPlan plan = plan_of(campaign, request.samples);
    return run_campaign(
        results, jobs, watch,
        {plan.runs(), [&campaign, plan](std::uint32_t run) {
             const rare::RarePoint point = point_of(plan, run);
             return campaign::RunToFly{row_to_fly(campaign, run, point.normals), point.noise};
         }});
}

}  // namespace limpet::study
