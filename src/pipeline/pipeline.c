#include "pipeline/pipeline.h"

bt_status bt_stage_campaign(bt_study_directory* directory, const bt_campaign_options* options,
                            bt_campaign_progress* progress) {
    return bt_campaign_run(directory->study, directory->ledger, options, progress, directory->diag);
}

bt_status bt_stage_study(bt_study_directory* directory, const bt_campaign_options* campaign,
                         const bt_reliability_stage* reliability, bt_campaign_progress* progress,
                         bt_surrogate* surrogate) {
    BT_TRY(bt_stage_campaign(directory, campaign, progress));
    BT_TRY(bt_stage_fit(directory, false, surrogate, NULL));
    const bt_status status = bt_stage_reliability(directory, surrogate, reliability, NULL);
    if (status != BT_OK)
        bt_surrogate_destroy(surrogate);
    return status;
}
