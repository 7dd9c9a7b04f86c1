/// How far a campaign is, for programs: status.json and `campaign status --json` have these keys.
#ifndef BT_REPORT_CAMPAIGN_STATUS_H
#define BT_REPORT_CAMPAIGN_STATUS_H

#include "campaign/campaign.h"
#include "report/json.h"

typedef struct bt_campaign_status {
    int64_t wanted, done, engaged, missed, failed;
    double rate_per_s;  ///< landings a second; NAN: nobody works
    uint64_t content;   ///< hash of the ledger
    const char* ledger; ///< its path
} bt_campaign_status;

/// Of a campaign under way, in which `progress` was made; `content` is left to the caller.
bt_campaign_status bt_campaign_status_of(const bt_campaign_progress* progress);

/// done, wanted, failed, rate_per_s, left_s, estimate (share engaged of the landings so far, each
/// counted once), half_width (of its 95 % Clopper-Pearson interval), content; then engaged, missed,
/// ledger, and what version 0.1 called total and ledger_hash. What is not known is null.
void bt_campaign_status_write(bt_json* json, const bt_campaign_status* status);

#endif
