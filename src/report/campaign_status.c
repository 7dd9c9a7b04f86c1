#include "report/campaign_status.h"

#include "statistics/intervals.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

bt_campaign_status bt_campaign_status_of(const bt_campaign_progress* p) {
    const int64_t fresh = p->done - p->before;
    return (bt_campaign_status){.wanted = p->total,
                                .done = p->done,
                                .engaged = p->engaged,
                                .missed = p->missed,
                                .failed = p->failed,
                                .rate_per_s = p->seconds > 0 ? (double)fresh / p->seconds : NAN};
}

void bt_campaign_status_write(bt_json* json, const bt_campaign_status* s) {
    const int64_t labelled = s->engaged + s->missed;
    const bt_interval ci95 = bt_clopper_pearson(s->engaged, labelled, 0.95);
    const int64_t left = s->wanted > s->done ? s->wanted - s->done : 0;
    char content[24];
    snprintf(content, sizeof content, "%016" PRIx64, s->content);
    bt_json_begin_object(json, NULL);
    bt_json_integer(json, "done", s->done);
    bt_json_integer(json, "wanted", s->wanted);
    bt_json_integer(json, "failed", s->failed);
    bt_json_number(json, "rate_per_s", s->rate_per_s);
    bt_json_number(json, "left_s",
                   left == 0           ? 0
                   : s->rate_per_s > 0 ? (double)left / s->rate_per_s
                                       : NAN);
    bt_json_number(json, "estimate", labelled > 0 ? (double)s->engaged / (double)labelled : NAN);
    bt_json_number(json, "half_width", 0.5 * (ci95.greatest - ci95.least));
    bt_json_string(json, "content", content);
    bt_json_integer(json, "engaged", s->engaged);
    bt_json_integer(json, "missed", s->missed);
    bt_json_integer(json, "total", s->wanted);
    bt_json_string(json, "ledger", s->ledger);
    bt_json_string(json, "ledger_hash", content);
    bt_json_end_object(json);
}
