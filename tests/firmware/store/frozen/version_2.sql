PRAGMA foreign_keys=OFF;
BEGIN TRANSACTION;
CREATE TABLE scans (
  seq INTEGER PRIMARY KEY,
  station TEXT NOT NULL,
  number INTEGER NOT NULL,
  taken_ms INTEGER NOT NULL,
  taken_synchronised INTEGER NOT NULL,
  received_ms INTEGER NOT NULL,
  received_synchronised INTEGER NOT NULL,
  status TEXT NOT NULL,
  supersedes INTEGER,
  superseded_by INTEGER,
  is_corrected INTEGER NOT NULL DEFAULT 0,
  is_wrong INTEGER NOT NULL DEFAULT 0,
  foods TEXT NOT NULL,
  words TEXT NOT NULL,
  document_bytes INTEGER NOT NULL
) STRICT;
INSERT INTO scans VALUES(1,'kitchen',1,1795765260000,1,1795765200000,1,'ok',NULL,2,0,0,replace('\nrice\npeas\nmeatballs\ngravy\n','\n',char(10)),replace('kitchen-1\ntray 12\nall items were measured.\nrice\npeas\nmeatballs\ngravy\n','\n',char(10)),2692);
INSERT INTO scans VALUES(2,'kitchen',2,1795765200000,1,1795765200000,1,'ok',1,NULL,1,0,replace('\nbulgur\ncorn\npeas\nmeatballs\ngravy\n','\n',char(10)),replace('kitchen-2\ntray 12\nall items were measured.\nrice\npeas\nmeatballs\ngravy\n','\n',char(10)),2699);
INSERT INTO scans VALUES(3,'kitchen',3,1795765380000,1,1795765200000,1,'ok',NULL,NULL,0,0,replace('\nrice\npeas\nmeatballs\ngravy\n','\n',char(10)),replace('kitchen-3\ntray 12\nall items were measured.\nrice\npeas\nmeatballs\ngravy\n','\n',char(10)),2692);
CREATE TABLE documents (
  seq INTEGER PRIMARY KEY REFERENCES scans (seq) ON DELETE CASCADE,
  body TEXT NOT NULL
) STRICT;
INSERT INTO documents VALUES(1,'{"version":2,"id":"kitchen-1","station":"kitchen","number":1,"taken_at":"2026-11-27T07:41:00.000Z","clock_synchronised":true,"supersedes":null,"tray":"tray 12","status":"ok","message":"All items were measured.","items":[{"label":2,"dish":1,"status":"ok","volume_ml":83.25,"sigma_ml":1.7770277684250002,"column_volume_ml":84.277777768425,"area_mm2":5123.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"rice","food_probability":0.9123456789012345,"mass_g":70.7625,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":109.252777768425,"protein_g":4.357777768425,"fat_g":3.525277768425,"carbohydrate_g":9.352777768425,"salt_g":0.36177776842500003}},{"label":3,"dish":1,"status":"ok","volume_ml":114.375,"sigma_ml":2.4414120241875,"column_volume_ml":115.78703702418751,"area_mm2":5124.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"peas","food_probability":0.9123456789012345,"mass_g":97.21875,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":150.0995370241875,"protein_g":5.9870370241875,"fat_g":4.8432870241875,"carbohydrate_g":12.8495370241875,"salt_g":0.4970370241875}},{"label":4,"dish":1,"status":"ok","volume_ml":145.5,"sigma_ml":3.1057962799500003,"column_volume_ml":147.29629627995,"area_mm2":5125.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"meatballs","food_probability":0.9123456789012345,"mass_g":123.675,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":190.94629627995002,"protein_g":7.616296279949999,"fat_g":6.16129627995,"carbohydrate_g":16.34629627995,"salt_g":0.63229627995}},{"label":5,"dish":1,"status":"ok","volume_ml":176.625,"sigma_ml":3.7701805357125004,"column_volume_ml":178.8055555357125,"area_mm2":5126.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"gravy","food_probability":0.9123456789012345,"mass_g":150.13125,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":231.7930555357125,"protein_g":9.2455555357125,"fat_g":7.4793055357125,"carbohydrate_g":19.843055535712498,"salt_g":0.7675555357125}}],"relative_angle_deg":18.123456789012344,"duration_ms":2211.123456789,"timing_ms":{"undistort":17.123456789012344,"card":17.123456789012344,"dish":17.123456789012344,"tracking":17.123456789012344,"adjustment":17.123456789012344,"rectify":17.123456789012344,"stereo":17.123456789012344,"fusion":17.123456789012344,"height_map":17.123456789012344,"volume":17.123456789012344,"segmentation":17.123456789012344,"total":188.12345678901235},"warnings":[{"code":"items_doubtful","message":"Two items touch and have one colour: they may be one food.","label":3}]}');
INSERT INTO documents VALUES(2,'{"version":2,"id":"kitchen-2","station":"kitchen","number":2,"taken_at":"2026-11-27T07:40:00.000Z","clock_synchronised":true,"supersedes":"kitchen-1","tray":"tray 12","status":"ok","message":"All items were measured.","items":[{"label":2,"dish":1,"status":"ok","volume_ml":83.25,"sigma_ml":1.7770277684250002,"column_volume_ml":84.277777768425,"area_mm2":5123.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"rice","food_probability":0.9123456789012345,"mass_g":70.7625,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":109.252777768425,"protein_g":4.357777768425,"fat_g":3.525277768425,"carbohydrate_g":9.352777768425,"salt_g":0.36177776842500003}},{"label":3,"dish":1,"status":"ok","volume_ml":114.375,"sigma_ml":2.4414120241875,"column_volume_ml":115.78703702418751,"area_mm2":5124.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"peas","food_probability":0.9123456789012345,"mass_g":97.21875,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":150.0995370241875,"protein_g":5.9870370241875,"fat_g":4.8432870241875,"carbohydrate_g":12.8495370241875,"salt_g":0.4970370241875}},{"label":4,"dish":1,"status":"ok","volume_ml":145.5,"sigma_ml":3.1057962799500003,"column_volume_ml":147.29629627995,"area_mm2":5125.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"meatballs","food_probability":0.9123456789012345,"mass_g":123.675,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":190.94629627995002,"protein_g":7.616296279949999,"fat_g":6.16129627995,"carbohydrate_g":16.34629627995,"salt_g":0.63229627995}},{"label":5,"dish":1,"status":"ok","volume_ml":176.625,"sigma_ml":3.7701805357125004,"column_volume_ml":178.8055555357125,"area_mm2":5126.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"gravy","food_probability":0.9123456789012345,"mass_g":150.13125,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":231.7930555357125,"protein_g":9.2455555357125,"fat_g":7.4793055357125,"carbohydrate_g":19.843055535712498,"salt_g":0.7675555357125}}],"relative_angle_deg":18.123456789012344,"duration_ms":2211.123456789,"timing_ms":{"undistort":17.123456789012344,"card":17.123456789012344,"dish":17.123456789012344,"tracking":17.123456789012344,"adjustment":17.123456789012344,"rectify":17.123456789012344,"stereo":17.123456789012344,"fusion":17.123456789012344,"height_map":17.123456789012344,"volume":17.123456789012344,"segmentation":17.123456789012344,"total":188.12345678901235},"warnings":[{"code":"items_doubtful","message":"Two items touch and have one colour: they may be one food.","label":3}]}');
INSERT INTO documents VALUES(3,'{"version":2,"id":"kitchen-3","station":"kitchen","number":3,"taken_at":"2026-11-27T07:43:00.000Z","clock_synchronised":true,"supersedes":null,"tray":"tray 12","status":"ok","message":"All items were measured.","items":[{"label":2,"dish":1,"status":"ok","volume_ml":83.25,"sigma_ml":1.7770277684250002,"column_volume_ml":84.277777768425,"area_mm2":5123.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"rice","food_probability":0.9123456789012345,"mass_g":70.7625,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":109.252777768425,"protein_g":4.357777768425,"fat_g":3.525277768425,"carbohydrate_g":9.352777768425,"salt_g":0.36177776842500003}},{"label":3,"dish":1,"status":"ok","volume_ml":114.375,"sigma_ml":2.4414120241875,"column_volume_ml":115.78703702418751,"area_mm2":5124.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"peas","food_probability":0.9123456789012345,"mass_g":97.21875,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":150.0995370241875,"protein_g":5.9870370241875,"fat_g":4.8432870241875,"carbohydrate_g":12.8495370241875,"salt_g":0.4970370241875}},{"label":4,"dish":1,"status":"ok","volume_ml":145.5,"sigma_ml":3.1057962799500003,"column_volume_ml":147.29629627995,"area_mm2":5125.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"meatballs","food_probability":0.9123456789012345,"mass_g":123.675,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":190.94629627995002,"protein_g":7.616296279949999,"fat_g":6.16129627995,"carbohydrate_g":16.34629627995,"salt_g":0.63229627995}},{"label":5,"dish":1,"status":"ok","volume_ml":176.625,"sigma_ml":3.7701805357125004,"column_volume_ml":178.8055555357125,"area_mm2":5126.456789012345,"mean_height_mm":16.123456789012344,"max_height_mm":31.98765432109876,"food":"gravy","food_probability":0.9123456789012345,"mass_g":150.13125,"mass_sigma_g":3.123456789012345,"nutrients":{"energy_kcal":231.7930555357125,"protein_g":9.2455555357125,"fat_g":7.4793055357125,"carbohydrate_g":19.843055535712498,"salt_g":0.7675555357125}}],"relative_angle_deg":18.123456789012344,"duration_ms":2211.123456789,"timing_ms":{"undistort":17.123456789012344,"card":17.123456789012344,"dish":17.123456789012344,"tracking":17.123456789012344,"adjustment":17.123456789012344,"rectify":17.123456789012344,"stereo":17.123456789012344,"fusion":17.123456789012344,"height_map":17.123456789012344,"volume":17.123456789012344,"segmentation":17.123456789012344,"total":188.12345678901235},"warnings":[{"code":"items_doubtful","message":"Two items touch and have one colour: they may be one food.","label":3}]}');
CREATE TABLE corrections (
  seq INTEGER NOT NULL REFERENCES scans (seq) ON DELETE CASCADE,
  number INTEGER NOT NULL,
  made_ms INTEGER NOT NULL,
  made_synchronised INTEGER NOT NULL,
  author TEXT NOT NULL,
  reason TEXT NOT NULL,
  action TEXT NOT NULL,
  PRIMARY KEY (seq, number)
) STRICT, WITHOUT ROWID;
INSERT INTO corrections VALUES(2,1,1795765200000,1,'chef','tasted','{"action":"rename","food":"bulgur","item":2}');
INSERT INTO corrections VALUES(2,2,1795765200000,1,'chef','','{"action":"split","food":"corn","item":2,"volume_ml":20.0}');
CREATE TABLE destinations (
  key INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  is_configured INTEGER NOT NULL
) STRICT;
INSERT INTO destinations VALUES(1,'webhook',1);
CREATE TABLE set_aside (
  number INTEGER PRIMARY KEY,
  received_ms INTEGER NOT NULL,
  received_synchronised INTEGER NOT NULL,
  why TEXT NOT NULL,
  digest INTEGER NOT NULL,
  document BLOB NOT NULL
) STRICT;
INSERT INTO set_aside VALUES(1,1795765200000,1,'the document is no JSON object of at most 1048576 bytes and 32 levels',-6242584266792580653,X'6e6f20646f63756d656e74');
CREATE TABLE IF NOT EXISTS "deliveries" (
  destination INTEGER NOT NULL REFERENCES destinations (key),
  place INTEGER NOT NULL,
  turn INTEGER NOT NULL DEFAULT 0,
  seq INTEGER NOT NULL,
  correction INTEGER NOT NULL DEFAULT 0,
  attempts INTEGER NOT NULL DEFAULT 0,
  next_ms INTEGER NOT NULL DEFAULT 0,
  last_failure TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (destination, place, turn)
) STRICT, WITHOUT ROWID;
INSERT INTO deliveries VALUES(1,2,0,2,0,1,1795765230000,'refused');
INSERT INTO deliveries VALUES(1,3,0,3,0,0,0,'');
INSERT INTO deliveries VALUES(1,3,1,2,1,0,0,'');
INSERT INTO deliveries VALUES(1,3,2,2,2,0,0,'');
CREATE UNIQUE INDEX scans_by_id ON scans (station, number);
CREATE INDEX scans_by_superseded ON scans (station, supersedes) WHERE supersedes IS NOT NULL;
CREATE INDEX set_aside_by_digest ON set_aside (digest);
CREATE INDEX deliveries_of_corrections ON deliveries (seq) WHERE correction > 0;
COMMIT;
PRAGMA application_id = 1414678361; PRAGMA user_version = 2;
